"""The same robots in MuJoCo: a second engine behind the plant, and MJCF for anybody else."""
