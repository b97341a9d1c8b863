"""The tree of frames says where every link of the URDF is."""

from __future__ import annotations

from xml.etree import ElementTree

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import apnc
from apnc.report.frames import frames_of
from apnc_plant.robot.urdf import robot_urdf


@pytest.fixture(scope="module", params=["lilibot", "hexapod"])
def record(request: pytest.FixtureRequest) -> apnc.Record:
    return apnc.simulate(
        apnc.Experiment(robot=request.param, duration=2.0, mi=0.3, turn=0.5, engine="compiled")
    )


def test_chains_end_where_the_plant_says_the_feet_are(record: apnc.Record) -> None:
    place, turn = {"world": np.zeros((len(record), 3))}, {"world": Rotation.identity()}
    for frame in frames_of(record):
        above = turn[frame.parent]
        place[frame.name] = place[frame.parent] + above.apply(frame.translation)
        turn[frame.name] = above * Rotation.from_quat(frame.rotation)
    for number, leg in enumerate(record.legs):
        foot = record.signals["foot_position"][:, number]
        np.testing.assert_allclose(place[f"{leg}_foot"], foot, atol=1e-9)


def test_each_link_of_the_urdf_has_its_frame_below_the_link_it_hangs_on(
    record: apnc.Record,
) -> None:
    model = ElementTree.fromstring(robot_urdf(record.robot))
    links = {link.attrib["name"] for link in model.iter("link")}
    hangs = {
        (joint.find("parent").attrib["link"], joint.find("child").attrib["link"])
        for joint in model.iter("joint")
    }
    frames = frames_of(record)
    assert {frame.name for frame in frames} == links
    assert {(frame.parent, frame.name) for frame in frames} == hangs | {("world", "trunk")}
