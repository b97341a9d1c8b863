"""MJCF files as a tree of parts: MuJoCo resolves defaults, the mass stays that of the file."""
# ruff: noqa: PLC0415  # mujoco is an extra

from __future__ import annotations

import importlib.util
import math
import warnings
from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

import numpy as np
from lxml import etree

from apnc.extras import missing
from apnc.importing import mjcf_xml
from apnc.importing.model import (
    NO_BODY,
    Frame,
    Joint,
    Model,
    ModelFileError,
    Motor,
    Part,
    Shape,
    moved,
)
from apnc.importing.xml_file import Element
from apnc_core.types import Array
from apnc_plant.robot import MassProperties

_SMALLEST_MASS: Final = 1e-9
"""What MuJoCo takes a body without mass for [kg]; it is a mere frame here."""

_LEAST_RADIUS: Final = 1e-3
"""Of the ball that stands for a mesh [m]."""


def read_mjcf(root: Element, path: Path) -> Model:
    """The robot of a MJCF file.

    The base is the body with a free joint; without one, that body of the world that carries the
    most others, whose own joints are then left out. A body with several joints becomes as many
    parts, of which the last has its mass.

    Args:
        root: the element ``<mujoco>``.
        path: of the file, for includes and messages.

    Raises:
        ModelFileError: MuJoCo refuses the file, an include lies outside of its folder, or the mass
            of a body is that of a mesh.
        ValueError: MuJoCo is not installed.
    """
    if importlib.util.find_spec("mujoco") is None:
        raise ValueError(missing("mujoco", "mujoco"))
    mjcf_xml.put_in_includes(root, path)
    mjcf_xml.check_numbers(root)
    keys = {
        key.get("name"): key.get("qpos") for found in root.iter("keyframe") for key in found
        if key.get("name") and key.get("qpos")
    }  # fmt: skip
    tied = mjcf_xml.tied(root)
    speeds = mjcf_xml.no_load_speeds(root)
    dropped = mjcf_xml.strip(root)
    spec, model, left_out = _compiled(root)
    if left_out:
        dropped.append(f"{len(left_out)} meshes: neither shape nor mass is taken from them")
    reader = _Reader(spec, model, left_out, tied, speeds)
    parts = reader.parts()
    poses = {name: reader.pose(text, name) for name, text in keys.items()}
    return Model(root.get("model") or path.stem, tuple(parts), poses, tuple(dropped))


def _compiled(root: Element) -> tuple[Any, Any, set[int]]:
    """The file as MuJoCo's specification and model, and the numbers of shapes left out."""
    import mujoco

    kinds = mujoco.mjtGeom
    not_read = (kinds.mjGEOM_MESH, kinds.mjGEOM_HFIELD, kinds.mjGEOM_SDF)
    try:
        spec = mujoco.MjSpec.from_string(etree.tostring(root, encoding="unicode"))
        meshes = [geom for body in spec.bodies for geom in body.geoms if geom.type in not_read]
        for geom in meshes:
            _check_mass(spec, geom)
            # a shape without mass in its place, since MuJoCo would look for the file
            geom.type, geom.size = kinds.mjGEOM_SPHERE, [_LEAST_RADIUS, 0.0, 0.0]
            geom.meshname, geom.hfieldname, geom.mass = "", "", 0.0
        spec.compiler.boundmass = max(spec.compiler.boundmass, _SMALLEST_MASS)
        spec.compiler.boundinertia = max(spec.compiler.boundinertia, _SMALLEST_MASS)
        spec.compiler.balanceinertia = True
        spec.compiler.fusestatic = False
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of the motion, which nobody computes here
            model = spec.compile()
    except ModelFileError:
        raise
    except (ValueError, RuntimeError, TypeError) as error:
        raise ModelFileError(f"MuJoCo refuses it: {' '.join(str(error).split())}") from None
    return spec, model, {geom.id for geom in meshes}


def _from_shapes(spec: Any, body: Any) -> bool:
    """True if MuJoCo takes the mass of a body from its shapes."""
    import mujoco

    always = mujoco.mjtInertiaFromGeom.mjINERTIAFROMGEOM_TRUE
    return bool(spec.compiler.inertiafromgeom == always or not body.explicitinertial)


def _check_mass(spec: Any, mesh: Any) -> None:
    """Refuse a mesh from which MuJoCo would take mass."""
    body = mesh.parent
    first, last = spec.compiler.inertiagrouprange
    weightless = mesh.mass == 0.0 or mesh.density == 0.0 or not first <= mesh.group <= last
    if body.name != "world" and _from_shapes(spec, body) and not weightless:
        raise ModelFileError(
            f"body {body.name}: its mass is that of mesh {mesh.meshname!r}, which is not read; "
            "allowed: bodies with <inertial> or simple shapes"
        )


class _Reader:
    """Parts of a compiled model."""

    def __init__(
        self, spec: Any, model: Any, left_out: set[int], tied: Mapping[str, str],
        speeds: Mapping[str, float],
    ) -> None:  # fmt: skip
        self._model, self._left_out, self._tied, self._speeds = model, left_out, tied, speeds
        self._bodies = {body.id: body for body in spec.bodies}
        self._spec = spec
        self._base = self._floating()

    def parts(self) -> list[Part]:
        """The base and what it carries, then the sites as frames."""
        model, parts = self._model, []
        last: dict[int, tuple[int, Array]] = {}  # of a body: its last part, and where that sits
        for body in range(1, model.nbody):
            parent = int(model.body_parentid[body])
            if body != self._base and parent not in last:
                continue
            index, shift = last.get(parent, (-1, np.zeros(3)))
            frame = _frame(model.body_pos[body] - shift, model.body_quat[body])
            if body == self._base:
                frame, joints = Frame(), []
            else:
                first = int(model.body_jntadr[body])
                joints = list(range(first, first + int(model.body_jntnum[body])))
            name, shift = self._name("body", body), np.zeros(3)
            for joint in joints:
                anchor = np.array(model.jnt_pos[joint])
                placed = Frame(frame.at(anchor - shift), frame.turn)
                parts.append(Part(name, index, placed, NO_BODY, self._joint(joint, body)))
                index, shift, frame = len(parts) - 1, anchor, Frame()
            at = Frame(-shift)
            own = moved(self._mass(body), at)
            shapes = tuple(self._shapes(body, at))
            if joints:
                parts[-1] = replace(parts[-1], body=own, shapes=shapes)
            else:
                parts.append(Part(name, index, frame, own, None, shapes))
            last[body] = len(parts) - 1, shift
        for site in range(model.nsite):
            body = int(model.site_bodyid[site])
            if body in last:
                index, shift = last[body]
                frame = _frame(model.site_pos[site] - shift, model.site_quat[site])
                parts.append(Part(self._name("site", site), index, frame, NO_BODY))
        return parts

    def pose(self, qpos: str, name: str) -> dict[str, float]:
        """Angles of a keyframe, by joint, from where the file draws the robot."""
        model = self._model
        try:
            values = [float(word) for word in qpos.split()]
        except ValueError:
            values = []
        if len(values) != model.nq:
            raise ModelFileError(f"key {name} has {len(values)} numbers; allowed: {model.nq}")
        angles = {}
        for joint in range(model.njnt):
            if self._hinge(joint):
                at = int(model.jnt_qposadr[joint])
                angles[self._name("joint", joint)] = values[at] - float(model.qpos0[at])
        return angles

    def _floating(self) -> int:
        """The body with a free joint, or else the one of the world that carries the most."""
        import mujoco

        model = self._model
        for joint in range(model.njnt):
            if model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_FREE:
                return int(model.jnt_bodyid[joint])
        carried = [0] * model.nbody
        for body in range(1, model.nbody):
            carried[int(model.body_rootid[body])] += 1
        if model.nbody < 2:
            raise ModelFileError("it has no body; allowed: a robot")
        return int(np.argmax(carried))

    def _name(self, kind: str, index: int) -> str:
        named = getattr(self._model, kind)(index).name
        return str(named) or f"{kind} {index}"

    def _hinge(self, joint: int) -> bool:
        import mujoco

        return bool(self._model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_HINGE)

    def _mass(self, index: int) -> MassProperties:
        """As in the file; MuJoCo computes principal axes to a few digits only."""
        model, body = self._model, self._bodies[index]
        if _from_shapes(self._spec, body):
            mass, diagonal = float(model.body_mass[index]), model.body_inertia[index]
            if mass <= 2.0 * _SMALLEST_MASS:
                return NO_BODY
        else:
            mass, diagonal = float(body.mass), np.array(body.inertia)
            full = np.array(body.fullinertia)
            if np.isfinite(full).all():
                xx, yy, zz, xy, xz, yz = full
                inertia = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
                return MassProperties(mass, np.array(body.ipos), inertia)
        turn = _frame(np.zeros(3), model.body_iquat[index]).turn
        inertia = turn @ np.diag(diagonal) @ turn.T
        return MassProperties(mass, np.array(model.body_ipos[index]), inertia)

    def _joint(self, index: int, body: int) -> Joint:
        model, name = self._model, self._name("joint", index)
        kind = "hinge" if self._hinge(index) else ("ball", "slide")[model.jnt_type[index] == 2]
        lower, upper = -math.inf, math.inf
        if model.jnt_limited[index] and kind != "ball":
            zero = float(model.qpos0[int(model.jnt_qposadr[index])])
            lower, upper = (float(limit) - zero for limit in model.jnt_range[index])
        follows = self._tied.get(name) or self._tied.get(self._name("body", body), "")
        axis = np.array(model.jnt_axis[index])
        return Joint(name, kind, axis, lower, upper, self._motor(index), follows)

    def _motor(self, joint: int) -> Motor:
        """The drive of a joint: its actuators, and damping, friction and limits of its own."""
        import mujoco

        model, at = self._model, int(self._model.jnt_dofadr[joint])
        efforts, stiffness, damping = [], None, 0.0
        if getattr(model, "jnt_actfrclimited", [False] * model.njnt)[joint]:
            efforts.append(float(model.jnt_actfrcrange[joint][1]))
        for actuator in range(model.nu):
            on_joint = model.actuator_trntype[actuator] == mujoco.mjtTrn.mjTRN_JOINT
            if not on_joint or model.actuator_trnid[actuator][0] != joint:
                continue
            gear = abs(float(model.actuator_gear[actuator][0]))
            gain = float(model.actuator_gainprm[actuator][0])
            fixed = model.actuator_gaintype[actuator] == mujoco.mjtGain.mjGAIN_FIXED
            affine = model.actuator_biastype[actuator] == mujoco.mjtBias.mjBIAS_AFFINE
            bias = model.actuator_biasprm[actuator]
            if model.actuator_forcelimited[actuator]:
                efforts.append(gear * float(model.actuator_forcerange[actuator][1]))
            if fixed and affine and bias[1] < 0.0:
                stiffness = gain * gear**2
                damping += -float(bias[2]) * gear**2
            elif fixed and not affine and model.actuator_ctrllimited[actuator]:
                efforts.append(gear * abs(gain) * float(model.actuator_ctrlrange[actuator][1]))
        effort = min((each for each in efforts if each > 0.0), default=None)
        return Motor(
            effort=effort,
            velocity=self._speeds.get(self._name("joint", joint), self._speeds.get("")),
            stiffness=stiffness,
            damping=damping,
            passive=float(model.dof_damping[at]),
            friction=float(model.dof_frictionloss[at]),
            armature=float(model.dof_armature[at]),
        )

    def _shapes(self, body: int, at: Frame) -> Iterable[Shape]:
        import mujoco

        model, kinds = self._model, mujoco.mjtGeom
        known = {
            kinds.mjGEOM_SPHERE: "sphere", kinds.mjGEOM_CAPSULE: "capsule",
            kinds.mjGEOM_CYLINDER: "cylinder", kinds.mjGEOM_BOX: "box",
            kinds.mjGEOM_ELLIPSOID: "ellipsoid",
        }  # fmt: skip
        first = int(model.body_geomadr[body])
        for geom in range(first, first + int(model.body_geomnum[body])):
            kind = known.get(kinds(int(model.geom_type[geom])))
            if kind is None or geom in self._left_out:
                continue
            size = model.geom_size[geom]
            half = {
                "sphere": [size[0]] * 3,
                "cylinder": [size[0], size[0], size[1]],
                "capsule": [size[0], size[0], size[0] + size[1]],
            }.get(kind, size)
            touches = bool(model.geom_contype[geom] or model.geom_conaffinity[geom])
            frame = at @ _frame(model.geom_pos[geom], model.geom_quat[geom])
            yield Shape(self._name("geom", geom), kind, frame, np.array(half), touches)


def _frame(position: Any, quaternion: Any) -> Frame:
    """A frame of MuJoCo; quaternions have w first."""
    w, x, y, z = (float(each) for each in quaternion)
    turn = np.array(
        [
            [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
            [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
            [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
        ]
    )
    return Frame(np.array(position, dtype=float), turn)
