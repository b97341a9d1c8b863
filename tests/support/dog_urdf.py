"""A made-up dog as URDF: mirrored axes, turned frames, offsets, an arm and rotors."""

from __future__ import annotations

from dataclasses import dataclass, field

NAMES = ("fl", "fr", "hl", "hr")
FEMUR, SHANK, FOOT_AHEAD = 0.2, 0.21, 0.012
HIP_OUT, KNEE_OUT = 0.08, 0.02
MOUNT = (0.22, 0.07, 0.01)
RADIUS = 0.021


@dataclass
class Dog:
    """What a test changes of the dog.

    Args:
        names: of the legs, fl fr hl hr in this order.
        knee: range of each knee where positive angles lie behind the line from hip to foot [rad].
        hip: range of the hips [rad].
        effort, velocity: limits in the file.
        axes: axis of abduction and of hip and knee, in the frame of the trunk.
        arm: an arm with two joints and a gripper on the back.
        extra: elements at the end.
    """

    names: tuple[str, ...] = NAMES
    knee: dict[str, tuple[float, float]] = field(default_factory=dict)
    hip: tuple[float, float] = (-1.5, 3.0)
    effort: float = 30.0
    velocity: float = 20.0
    axes: tuple[str, str] = ("1 0 0", "0 1 0")
    arm: bool = True
    extra: str = ""

    def text(self) -> str:
        parts = [
            '<robot name="dog">',
            link("base"),
            fixed("base_to_trunk", "base", "trunk", "0.01 0 0.02"),
            link("trunk", 8.0, (0.02, 0.001, -0.01), (0.05, 0.13, 0.15), "0.5 -0.3 0.2", box),
        ]
        for name, (ahead, left) in zip(
            self.names, ((1, 1), (1, -1), (-1, 1), (-1, -1)), strict=True
        ):
            parts.append(self.leg(name, ahead, left))
        if self.arm:
            parts += [
                link("arm_base", 0.3, (0.0, 0.0, 0.02), (1e-3, 1e-3, 1e-3)),
                fixed("arm_mount", "trunk", "arm_base", "0.1 0 0.08", rpy="0.3 -0.4 0.5"),
                link("arm_upper", 0.5, (0.0, 0.0, 0.1), (2e-3, 2e-3, 1e-3)),
                hinge("arm_yaw", "arm_base", "arm_upper", "0 0 0.05", "0 0 1", (-3, 3)),
                link("arm_lower", 0.4, (0.1, 0.0, 0.0), (1e-3, 2e-3, 2e-3)),
                hinge("arm_pitch", "arm_upper", "arm_lower", "0 0 0.2", "0 1 0", (0.3, 2.0)),
                link("finger_a", 0.05, (0.02, 0.0, 0.0), (1e-5, 1e-5, 1e-5)),
                link("finger_b", 0.05, (0.02, 0.0, 0.0), (1e-5, 1e-5, 1e-5)),
                hinge("grip_a", "arm_lower", "finger_a", "0.2 0.02 0", "0 0 1", (-1, 1)),
                hinge("grip_b", "arm_lower", "finger_b", "0.2 -0.02 0", "0 0 1", (-1, 1)),
            ]
        return "\n".join([*parts, self.extra, "</robot>"])

    def leg(self, name: str, ahead: int, left: int) -> str:
        x, y, z = MOUNT
        aside, along = self.axes
        low, high = self.knee.get(name, (0.4, 2.6))
        # axes of legs on the right and of hind knees point the other way; the frame of the calf is
        # upside down, so that its axis points to the right where it reads 0 1 0
        turned, hip_range = "0 0 3.141592653589793", (-0.8, 0.8)
        hip_axis = flipped(aside) if left < 0 else aside
        thigh_range = self.hip if left > 0 else (-self.hip[1], -self.hip[0])
        thigh_axis = along if left > 0 else flipped(along)
        calf_axis = along if ahead > 0 else flipped(along)
        calf_range = (low, high) if ahead > 0 else (-high, -low)
        limits = {"effort": self.effort, "velocity": self.velocity}
        return "\n".join(
            (
                link(f"{name}_hip", 0.6, (0.01, 0.004 * left, 0.0), (6e-4, 8e-4, 7e-4)),
                hinge(f"{name}_haa", "trunk", f"{name}_hip", f"{ahead * x} {left * y} {z}",
                      hip_axis, hip_range, **limits),
                link(f"{name}_rotor", 0.1, (0.0, 0.0, 0.0), (1e-4, 2e-4, 1e-4)),
                fixed(f"{name}_rotor_mount", f"{name}_hip", f"{name}_rotor", f"0 {left * 0.04} 0"),
                link(f"{name}_thigh", 1.0, (-0.01, 0.01 * left, -0.05), (5e-3, 5e-3, 1e-3)),
                hinge(f"{name}_hfe", f"{name}_hip", f"{name}_thigh", f"0 {left * HIP_OUT} 0",
                      thigh_axis, thigh_range, **limits),
                link(f"{name}_calf", 0.2, (0.005, 0.0, 0.1), (2e-3, 2e-3, 1e-4)),
                hinge(f"{name}_kfe", f"{name}_thigh", f"{name}_calf",
                      f"0 {left * KNEE_OUT} {-FEMUR}", calf_axis, calf_range,
                      rpy="3.141592653589793 0 0", **limits),
                link(f"{name}_foot", 0.05, (0.0, 0.0, 0.0), (1e-5, 1e-5, 1e-5), collision=ball),
                fixed(f"{name}_ankle", f"{name}_calf", f"{name}_foot",
                      f"{FOOT_AHEAD} 0 {SHANK}", rpy=turned),
            )
        )  # fmt: skip


def flipped(axis: str) -> str:
    return " ".join(str(-float(each)) for each in axis.split())


def ball(radius: float = RADIUS) -> str:
    return f'<collision><geometry><sphere radius="{radius}"/></geometry></collision>'


def box() -> str:
    return (
        '<collision><origin xyz="0.03 0 0.01"/><geometry><box size="0.5 0.2 0.1"/></geometry>'
        "</collision>"
    )


def link(
    name: str,
    mass: float = 0.0,
    com: tuple[float, float, float] = (0.0, 0.0, 0.0),
    moments: tuple[float, float, float] = (0.0, 0.0, 0.0),
    rpy: str = "0 0 0",
    collision: object = None,
) -> str:
    inertial = ""
    if mass:
        xx, yy, zz = moments
        inertial = (
            f'<inertial><origin xyz="{com[0]} {com[1]} {com[2]}" rpy="{rpy}"/>'
            f'<mass value="{mass}"/><inertia ixx="{xx}" ixy="0" ixz="0" iyy="{yy}" iyz="0" '
            f'izz="{zz}"/></inertial>'
        )
    shape = collision() if callable(collision) else ""
    return f'<link name="{name}">{inertial}{shape}</link>'


def fixed(name: str, parent: str, child: str, xyz: str, rpy: str = "0 0 0") -> str:
    return (
        f'<joint name="{name}" type="fixed"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{xyz}" rpy="{rpy}"/></joint>'
    )


def hinge(
    name: str,
    parent: str,
    child: str,
    xyz: str,
    axis: str,
    limits: tuple[float, float],
    *,
    effort: float = 10.0,
    velocity: float = 10.0,
    rpy: str = "0 0 0",
    kind: str = "revolute",
) -> str:
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{xyz}" rpy="{rpy}"/><axis xyz="{axis}"/>'
        f'<limit lower="{limits[0]}" upper="{limits[1]}" effort="{effort}" '
        f'velocity="{velocity}"/></joint>'
    )
