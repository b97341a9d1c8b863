"""Other people's loaders of robots, each told apart from the rest by what it reads and says.

None of them is a dependency; ``pytest.importorskip`` leaves out what is not installed.
"""

from __future__ import annotations

import contextlib
import io
import os
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

from apnc_plant.robot import Servo

Angles = Mapping[str, float]
"""Joint angles by name [rad]."""


class Limits(NamedTuple):
    """Of a joint: angles [rad], torque [N m] and speed [rad/s]; None where a loader has no such."""

    lower: float
    upper: float
    torque: float | None = None
    speed: float | None = None


class Rest(NamedTuple):
    """What a second has led to: height of the trunk [m], force of the ground [N]."""

    height: float
    load: float


class Loaded(ABC):
    """A robot as a loader has read it."""

    joints: list[str]
    mass: float
    limits: dict[str, Limits]

    @abstractmethod
    def feet(self, angles: Angles) -> dict[str, np.ndarray]:
        """Places of the feet relative to the trunk, by leg [m]."""


class Simulated(Loaded):
    """A robot that the loader moves as well."""

    @abstractmethod
    def rest(self, height: float, roll: float) -> Rest:
        """A second on a level ground, servos at 0, from a height [m] and roll [rad]."""


def legs_of(joints: list[str]) -> list[str]:
    return [name.removesuffix("_hip") for name in joints if name.endswith("_hip")]


class Yourdfpy(Loaded):
    def __init__(self, text: str, folder: Path, servo: Servo) -> None:
        yourdfpy = pytest.importorskip("yourdfpy")
        self._model = yourdfpy.URDF.load(io.BytesIO(text.encode()))
        assert self._model.validate(), self._model.errors
        self.joints = list(self._model.actuated_joint_names)
        links = self._model.link_map.values()
        self.mass = sum(link.inertial.mass for link in links if link.inertial)
        self.limits = {
            joint.name: Limits(
                joint.limit.lower, joint.limit.upper, joint.limit.effort, joint.limit.velocity
            )
            for joint in self._model.actuated_joints
        }

    def feet(self, angles: Angles) -> dict[str, np.ndarray]:
        self._model.update_cfg(dict(angles))
        return {
            leg: self._model.get_transform(f"{leg}_foot", "trunk")[:3, 3]
            for leg in legs_of(self.joints)
        }


class Urchin(Loaded):
    def __init__(self, text: str, folder: Path, servo: Servo) -> None:
        urchin = pytest.importorskip("urchin")
        path = folder / "robot.urdf"
        path.write_text(text)
        self._model = urchin.URDF.load(str(path))
        self.joints = list(self._model.actuated_joint_names)
        self.mass = sum(link.inertial.mass for link in self._model.links)
        self.limits = {
            joint.name: Limits(
                joint.limit.lower, joint.limit.upper, joint.limit.effort, joint.limit.velocity
            )
            for joint in self._model.actuated_joints
        }

    def feet(self, angles: Angles) -> dict[str, np.ndarray]:
        places = self._model.link_fk(cfg=dict(angles), use_names=True)
        trunk = np.linalg.inv(places["trunk"])
        return {leg: (trunk @ places[f"{leg}_foot"])[:3, 3] for leg in legs_of(self.joints)}


class Pinocchio(Loaded):
    def __init__(self, text: str, folder: Path, servo: Servo) -> None:
        self._pin: Any = pytest.importorskip("pinocchio")
        if "<mujoco" in text:
            path = folder / "robot.xml"
            path.write_text(text)
            self._model = self._pin.buildModelFromMJCF(str(path))
            kind = self._pin.GeometryType.COLLISION
            self._geometry = self._pin.buildGeomFromMJCF(self._model, str(path), kind)
        else:
            self._model = self._pin.buildModelFromXML(text, self._pin.JointModelFreeFlyer())
            self._geometry = None
        self._data = self._model.createData()
        self.joints = list(self._model.names)[2:]
        self.mass = self._pin.computeTotalMass(self._model)
        self.limits = {}
        for name in self.joints:
            joint = self._joint(name)
            q, v = joint.idx_q, joint.idx_v
            self.limits[name] = Limits(
                self._model.lowerPositionLimit[q],
                self._model.upperPositionLimit[q],
                self._model.effortLimit[v],
                None if self._geometry else self._model.velocityLimit[v],
            )

    def _joint(self, name: str) -> Any:
        joint = self._model.joints[self._model.getJointId(name)]
        assert joint.nq == 1
        return joint

    def feet(self, angles: Angles) -> dict[str, np.ndarray]:
        q = self._pin.neutral(self._model)
        for name, angle in angles.items():
            q[self._joint(name).idx_q] = angle
        self._pin.forwardKinematics(self._model, self._data, q)
        self._pin.updateFramePlacements(self._model, self._data)
        if self._geometry is None:
            frame = {leg: self._model.getFrameId(f"{leg}_foot") for leg in legs_of(self.joints)}
            return {leg: self._data.oMf[at].translation.copy() for leg, at in frame.items()}
        shapes = self._geometry.createData()
        self._pin.updateGeometryPlacements(self._model, self._data, self._geometry, shapes, q)
        ball = {leg: self._geometry.getGeometryId(f"{leg}_foot") for leg in legs_of(self.joints)}
        return {leg: shapes.oMg[at].translation.copy() for leg, at in ball.items()}


class Mujoco(Simulated):
    def __init__(self, text: str, folder: Path, servo: Servo) -> None:
        self._mujoco: Any = pytest.importorskip("mujoco")
        spec = self._mujoco.MjSpec.from_string(text)
        urdf = "<mujoco" not in text
        if urdf:
            spec.compiler.fusestatic = False  # or the trunk is welded into the world
            spec.worldbody.first_body().add_freejoint()
            kind = self._mujoco.mjtGeom.mjGEOM_PLANE
            spec.worldbody.add_geom(name="ground", type=kind, size=[5.0, 5.0, 0.1])
            spec.option.timestep = 1.0 / 1920.0
        self._model = model = spec.compile()
        hinges = [k for k in range(model.njnt) if model.jnt_type[k] == 3]
        if urdf:  # a servo that holds 0
            model.jnt_stiffness[hinges] = servo.stiffness
            model.dof_damping[6:], model.dof_armature[6:] = servo.damping, servo.reflected_inertia
        self._data = self._mujoco.MjData(model)
        self.joints = [model.joint(k).name for k in hinges]
        self.mass = model.body_mass.sum()
        self.limits = {
            model.joint(k).name: Limits(*model.jnt_range[k], model.jnt_actfrcrange[k][1])
            for k in hinges
            if model.jnt_limited[k]
        }

    def feet(self, angles: Angles) -> dict[str, np.ndarray]:
        data = self._data
        self._mujoco.mj_resetData(self._model, data)
        for name, angle in angles.items():
            data.joint(name).qpos = angle
        self._mujoco.mj_kinematics(self._model, data)
        trunk, found = data.body("trunk"), {}
        for leg in legs_of(self.joints):
            body = self._model.body(f"{leg}_tibia_link").id
            balls = self._model.geom_type == self._mujoco.mjtGeom.mjGEOM_SPHERE
            (ball,) = np.flatnonzero(balls & (self._model.geom_bodyid == body))
            found[leg] = trunk.xmat.reshape(3, 3).T @ (data.geom_xpos[ball] - trunk.xpos)
        return found

    def rest(self, height: float, roll: float) -> Rest:
        data = self._data
        self._mujoco.mj_resetData(self._model, data)
        data.qpos[2:7] = height, np.cos(roll / 2.0), np.sin(roll / 2.0), 0.0, 0.0
        while data.time < 1.0:
            self._mujoco.mj_step(self._model, data)
        load, force = 0.0, np.zeros(6)
        for k in range(data.ncon):
            self._mujoco.mj_contactForce(self._model, data, k, force)
            load += (data.contact[k].frame.reshape(3, 3).T @ force[:3])[2]
        return Rest(data.body("trunk").xpos[2], load)


class PyBullet(Simulated):
    def __init__(self, text: str, folder: Path, servo: Servo) -> None:
        self._bullet: Any = pytest.importorskip("pybullet")
        bullet, self._servo = self._bullet, servo
        path = folder / "robot.urdf"
        path.write_text(text)
        self._client = bullet.connect(bullet.DIRECT)
        # without the flag it takes inertias from the collision shapes
        with quiet():
            self._robot = bullet.loadURDF(
                str(path), flags=bullet.URDF_USE_INERTIA_FROM_FILE, physicsClientId=self._client
            )
        self._at: dict[str, int] = {}
        self._link: dict[str, int] = {}
        self.limits = {}
        count = self._call(bullet.getNumJoints)
        for k in range(count):
            info = self._call(bullet.getJointInfo, k)
            self._link[info[12].decode()] = k
            if info[2] == bullet.JOINT_REVOLUTE:
                name = info[1].decode()
                self._at[name], self.limits[name] = k, Limits(*info[8:12])
        self.joints = list(self._at)
        self.mass = sum(self._call(bullet.getDynamicsInfo, k)[0] for k in range(-1, count))

    def _call(self, function: Callable[..., Any], *given: Any, **options: Any) -> Any:
        return function(self._robot, *given, physicsClientId=self._client, **options)

    def feet(self, angles: Angles) -> dict[str, np.ndarray]:
        bullet = self._bullet
        for name, angle in angles.items():
            self._call(bullet.resetJointState, self._at[name], angle)
        place, turn = self._call(bullet.getBasePositionAndOrientation)
        # it gives the centre of mass of the base, and of a link the frame as the fifth
        local, local_turn = self._call(bullet.getDynamicsInfo, -1)[3:5]
        inverse = bullet.invertTransform(local, local_turn)
        trunk = bullet.invertTransform(*bullet.multiplyTransforms(place, turn, *inverse))
        found = {}
        for leg in legs_of(self.joints):
            state = self._call(
                bullet.getLinkState, self._link[f"{leg}_foot"], computeForwardKinematics=True
            )
            found[leg] = np.array(bullet.multiplyTransforms(*trunk, *state[4:6])[0])
        return found

    def rest(self, height: float, roll: float) -> Rest:
        bullet, client = self._bullet, {"physicsClientId": self._client}
        plane = bullet.createCollisionShape(bullet.GEOM_PLANE, **client)
        ground = bullet.createMultiBody(0.0, plane, **client)
        bullet.setGravity(0.0, 0.0, -9.81, **client)
        offset = self._call(bullet.getDynamicsInfo, -1)[3]
        turn = bullet.getQuaternionFromEuler((roll, 0.0, 0.0))
        centre, _ = bullet.multiplyTransforms((0.0, 0.0, height), turn, offset, (0, 0, 0, 1))
        self._call(bullet.resetBasePositionAndOrientation, centre, turn)
        for joint in self._at.values():
            self._call(bullet.resetJointState, joint, 0.0)
            self._call(
                bullet.setJointMotorControl2, joint, bullet.POSITION_CONTROL,
                targetPosition=0.0, force=self._servo.stall_torque,
            )  # fmt: skip
        for _ in range(240):  # steps of 1/240 s
            bullet.stepSimulation(**client)
        touching = bullet.getContactPoints(self._robot, ground, **client)
        centre, turn = self._call(bullet.getBasePositionAndOrientation)
        inverse = bullet.invertTransform(offset, (0, 0, 0, 1))
        place, _ = bullet.multiplyTransforms(centre, turn, *inverse)
        return Rest(place[2], sum(point[9] for point in touching))


class Drake(Simulated):
    def __init__(self, text: str, folder: Path, servo: Servo) -> None:
        self._drake: Any = pytest.importorskip("pydrake.all")
        drake, builder = self._drake, self._drake.DiagramBuilder()
        self._plant, _ = drake.AddMultibodyPlantSceneGraph(builder, 1.0 / 960.0)
        plant, urdf = self._plant, "<mujoco" not in text
        (self._robot,) = (
            each
            for each in drake.Parser(plant).AddModelsFromString(text, "urdf" if urdf else "xml")
            if plant.HasBodyNamed("trunk", each)
        )
        joints = [
            plant.get_joint(k)
            for k in plant.GetJointIndices(self._robot)
            if plant.get_joint(k).type_name() == "revolute"
        ]
        if urdf:
            friction = drake.CoulombFriction(0.8, 0.8)
            plant.RegisterCollisionGeometry(
                plant.world_body(), drake.RigidTransform(), drake.HalfSpace(), "ground", friction
            )
        for joint in joints:
            if urdf:
                motor = plant.AddJointActuator(joint.name(), joint, servo.stall_torque)
                motor.set_default_rotor_inertia(servo.reflected_inertia)
                motor.set_default_gear_ratio(1.0)
            else:
                motor = plant.GetJointActuatorByName(joint.name(), self._robot)
                assert motor.get_controller_gains().p == servo.stiffness
            motor.set_controller_gains(drake.PdControllerGains(p=servo.stiffness, d=servo.damping))
        plant.Finalize()
        self._diagram = builder.Build()
        self.joints = [joint.name() for joint in joints]
        self.mass = plant.CalcTotalMass(plant.CreateDefaultContext())
        self.limits = {}
        for joint in joints:
            torque = plant.GetJointActuatorByName(joint.name(), self._robot).effort_limit()
            speed = float(joint.velocity_upper_limits()[0]) if urdf else None
            low, high = joint.position_lower_limits()[0], joint.position_upper_limits()[0]
            self.limits[joint.name()] = Limits(float(low), float(high), torque, speed)

    def _context(self) -> tuple[Any, Any]:
        root = self._diagram.CreateDefaultContext()
        return root, self._plant.GetMyContextFromRoot(root)

    def feet(self, angles: Angles) -> dict[str, np.ndarray]:
        plant, (_, context) = self._plant, self._context()
        for name, angle in angles.items():
            plant.GetJointByName(name, self._robot).set_angle(context, angle)
        trunk = plant.GetBodyByName("trunk", self._robot).body_frame()
        found = {}
        for leg in legs_of(self.joints):
            body = plant.GetBodyByName(f"{leg}_tibia_link", self._robot)
            inspector = self._diagram.GetSubsystemByName("scene_graph").model_inspector()
            (ball,) = (
                inspector.GetPoseInFrame(each).translation()
                for each in plant.GetCollisionGeometriesForBody(body)
                if isinstance(inspector.GetShape(each), self._drake.Sphere)
            )
            found[leg] = plant.CalcPointsPositions(
                context, body.body_frame(), ball[:, np.newaxis], trunk
            )[:, 0]
        return found

    def rest(self, height: float, roll: float) -> Rest:
        drake, plant, (root, context) = self._drake, self._plant, self._context()
        turn = drake.RotationMatrix.MakeXRotation(roll)
        place = drake.RigidTransform(turn, [0.0, 0.0, height])
        trunk = plant.GetBodyByName("trunk", self._robot)
        (base,) = plant.GetFloatingBaseBodies()
        plant.SetFreeBodyPose(context, plant.get_body(base), place)
        targets = np.zeros(2 * len(self.joints))
        plant.get_desired_state_input_port(self._robot).FixValue(context, targets)
        simulator = drake.Simulator(self._diagram, root)
        simulator.AdvanceTo(1.0)
        results = plant.get_contact_results_output_port().Eval(context)
        ground, load = plant.world_body().index(), 0.0
        for k in range(results.num_point_pair_contacts()):
            pair = results.point_pair_contact_info(k)
            if ground in (pair.bodyA_index(), pair.bodyB_index()):
                load += abs(float(pair.contact_force()[2]))
        return Rest(plant.EvalBodyPoseInWorld(context, trunk).translation()[2], load)


@contextlib.contextmanager
def quiet() -> Iterator[None]:
    """Without what compiled code prints."""
    kept = [os.dup(k) for k in (1, 2)]
    nothing = os.open(os.devnull, os.O_WRONLY)
    try:
        for k in (1, 2):
            os.dup2(nothing, k)
        yield
    finally:
        for k, was in zip((1, 2), kept, strict=True):
            os.dup2(was, k)
            os.close(was)
        os.close(nothing)
