"""The same robots in MuJoCo: another engine behind the plant, and MJCF for anybody else."""
