"""The FMU on the MJCF of a robot itself, in MuJoCo, through fmpy, without our plant and contact.

apnc build --output Apnc.fmu
python examples/07_foreign_mjcf.py robot.xml [MI]
"""

import sys

import mujoco
import numpy as np
from fmpy import extract, instantiate_fmu, read_model_description

from apnc import metrics
from apnc.importing import import_robot

path, mi = sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 else 0.12
found, spec, legs = import_robot(path), mujoco.MjSpec.from_file(path), range(4)
robot, P, D = found.robot, found.robot.servo.stiffness, found.robot.servo.damping
Ts, steps, limit = 1 / robot.rate, 40, robot.servo.stall_torque
spec.option.timestep, spec.option.disableflags = Ts / steps, mujoco.mjtDisableBit.mjDSBL_ACTUATION
floor = spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[0, 0, 1])
model = spec.compile()
data, joints = mujoco.MjData(model), [model.joint(each.name) for each in robot.joint_map]
at, dof = (np.concatenate([getattr(j, n) for j in joints]) for n in ("qposadr", "dofadr"))
pose, sign = (np.array([getattr(each, n) for each in robot.joint_map]) for n in ("offset", "sign"))
link = {int(model.jnt_bodyid[joints[3 * leg + 2].id]): leg for leg in legs}  # below each knee
leg_of = [link.get(int(model.body_weldid[body])) for body in model.geom_bodyid]
description = read_model_description("Apnc.fmu")
number = {v.name: v.valueReference for v in description.modelVariables}
names = ("grf", "theta_hip", "theta_knee", "o1", "o2")
loads, hips, knees, *cpg = ([number[f"leg[{leg + 1}].{name}"] for leg in legs] for name in names)
fmu = instantiate_fmu(extract("Apnc.fmu"), description)
fmu.setupExperiment(startTime=0.0)
fmu.enterInitializationMode()
for name, value in {"MI": mi, "Ts": Ts, "robot_weight": robot.weight, **robot.controller}.items():
    (fmu.setInteger if isinstance(value, int) else fmu.setReal)([number[name]], [value])
fmu.exitInitializationMode()
data.qpos[at], data.qpos[2], force = pose, 0.0, np.zeros(6)
while mujoco.mj_forward(model, data) or floor.id in data.contact.geom:
    data.qpos[2] += 0.002  # until it stands above the floor
load, q, samples = np.zeros(4), np.zeros(12), []
for n in range(round(30 / Ts)):
    fmu.setReal(loads, load)
    fmu.doStep(n * Ts, Ts)
    q[1::3], q[2::3] = fmu.getReal(hips), fmu.getReal(knees)
    for _ in range(steps):
        torque = P * (pose + sign * q - data.qpos[at]) - D * data.qvel[dof]
        data.qfrc_applied[dof] = np.clip(torque, -limit, limit)
        mujoco.mj_step(model, data)
    load *= 0.4  # of the load before, and 0.6 of the new one
    for contact, pair in enumerate(data.contact.geom):
        if floor.id in pair and (leg := leg_of[pair.sum() - floor.id]) is not None:
            mujoco.mj_contactForce(model, data, contact, force)
            load[leg] += 0.6 * force[0]  # along the normal
    samples.append((*data.qpos[:2], *fmu.getReal(cpg[0]), *fmu.getReal(cpg[1])))
place, o1, o2 = np.split(np.array(samples), [2, 6], axis=1)
time, error = Ts * np.arange(len(o1)), metrics.phase_error(o1, o2, metrics.default_target(4))
after, phi = metrics.settling_time(time, error, 0), metrics.final_phases(o1, o2, Ts).round(2)
print(f"{robot.name}: {robot.mass:.1f} kg at {robot.rate:.1f} Hz and MI {mi:g}, phases {phi} rad")
print(f"{metrics.path_length(place) / time[-1]:.3f} m/s, trot after {after and round(after, 1)} s")
