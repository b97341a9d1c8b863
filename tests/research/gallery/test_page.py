"""The gallery's page says of each robot which aims it misses."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from research.docs import DOCS
from research.gallery import page, store
from research.gallery.by_hand import ByHand
from research.gallery.measure import Walk
from research.gallery.robots import GalleryRobot

MIS = (0.1, 0.2)
DOG = GalleryRobot("dog", "Dog", "kennel", "dog.urdf", "MIT", why="It is lazy")
ABOUT: dict[str, Any] = {
    "robots": {
        "dog": {
            "mass": 12.0, "leg_length": 0.4, "version": "1.2", "minutes": 9.6, "candidates": 640,
            "commands": ["apnc tune dog.toml --candidates 640 --seed 1"], "at": ["89abcde"],
            "fmu": {"kB": 178, "rate": 41.76, "weight": 117.7, "mi": 0.15, "apart": 0.0},
        }
    },
    "refused": {"cat": "its knees bend the other way"},
    "commit": "0123456", "processor": "a processor", "seeds": 20, "first_seed": 7,
}  # fmt: skip


def made_up() -> list[Walk]:
    """Walks that reach every aim, those at which it is just reached."""
    return [
        Walk("dog", body, label, mi, seed, "complete", True, 3.0, 2.0 * mi, 0.05, 0.18)
        for body in ("own", "varied")
        for label in ("ANC", "APC")
        for mi in MIS
        for seed in range(20)
    ]


def failed(walks: list[Walk], count: int, **of: Any) -> list[Walk]:
    """The walks, with so many of those of a kind not strict."""
    found = []
    for walk in walks:
        hit = count > 0 and all(getattr(walk, name) == value for name, value in of.items())
        count -= hit
        found.append(replace(walk, strict=False) if hit else walk)
    return found


def changed(walks: list[Walk], mi: float, **values: Any) -> list[Walk]:
    return [replace(walk, **values) if walk.mi == mi else walk for walk in walks]


def test_aims_that_are_just_reached_are_reached() -> None:
    walks = failed(made_up(), 2, controller="APC", mi=0.2, body="own")
    assert page.missed(walks) == []
    # varied bodies show the margin, and are no aim
    assert page.missed(failed(walks, 9, body="varied")) == []


def test_each_aim_can_be_missed() -> None:
    walks = made_up()
    assert page.missed(failed(walks, 1, controller="ANC", mi=0.2, body="own")) == [
        "ANC 19/20 at MI 0.2"
    ]
    assert page.missed(failed(walks, 3, controller="APC", mi=0.1, body="own")) == [
        "APC 17/20 at MI 0.1"
    ]
    assert page.missed(changed(walks, 0.2, lift_share=0.049)) == ["lift 4.9 %"]
    assert page.missed(changed(walks, 0.1, slip_share=0.19)) == ["slip 19.0 %"]
    assert page.missed(changed(walks, 0.1, slip_share=None)) == ["slip -"]
    assert page.missed(changed(walks, 0.2, speed_m_per_s=0.2)) == [
        "speed does not grow: 0.200, 0.200"
    ]


def test_the_page_has_a_row_for_a_robot_and_a_line_for_one_that_was_refused(
    tmp_path: Path,
) -> None:
    cat = replace(DOG, name="cat", title="Cat")
    (tmp_path / "dog.webp").touch()
    text = page.text([DOG, cat], ABOUT, made_up(), tmp_path)
    assert "| Dog | 12.0 | 0.40 | URDF, kennel 1.2 | MIT | 9.6 | 640 |\n" in text
    assert "| Dog | 0.1 to 0.2 | 40/40 | 40/40 | 40/40 | 40/40 | 0.20 to 0.40 |" in text
    assert "| Dog | 178 | 41.8 | 117.7 | 0.15 | 0 |\n" in text
    assert "\napnc tune dog.toml --candidates 640 --seed 1  # 89abcde\n" in text
    assert "| 0.20 to 0.40 | 5.0 % | 18.0 % |\n" in text
    assert "- **Dog:** nothing\n" in text
    assert "**1 of 1 robots reach every aim: Dog.**" in text
    assert "- Cat: its knees bend the other way" in text
    assert f"(../pictures/{tmp_path.name}/dog.webp)" in text and "cat.webp" not in text
    assert "lazy" not in text
    assert "- **Dog:** slip 19.0 %. It is lazy.\n" in page.text(
        [DOG, cat], ABOUT, changed(made_up(), 0.1, slip_share=0.19), tmp_path
    )
    assert "commit 0123456" in text and "| 18 of 20 seeds at every MI |" in text


def test_a_robot_measured_at_another_commit_says_so(tmp_path: Path) -> None:
    about = ABOUT | {"refused": {}, "robots": {"dog": ABOUT["robots"]["dog"] | {"commit": "89ab"}}}
    assert "commit 0123456 (Dog at 89ab), " in page.text([DOG], about, made_up(), tmp_path)


def test_the_page_says_how_to_get_a_robot_of_a_repository(tmp_path: Path) -> None:
    dog = replace(
        DOG, package="", repository="host/dogs", commit="0123456789abcdef", by_hand=ByHand()
    )
    about = ABOUT | {"refused": {}}
    text = page.text([dog], about, made_up(), tmp_path)
    assert "| Dog | 12.0 | 0.40 | URDF, host/dogs 1.2 | MIT | by hand |" in text
    assert "gains of Dog were set by hand" in text
    assert "so that of Dog comes from a repository" in text
    assert (
        "git clone https://host/dogs dog && git -C dog checkout 0123456789abcdef\n"
        "export DOG_ROOT=$PWD/dog\n" in text
    )
    assert "git clone" not in page.text([DOG], about, made_up(), tmp_path)


def test_walks_are_stored_and_read_again(tmp_path: Path) -> None:
    walks = [*made_up()[:2], replace(made_up()[0], strict=False, convergence_time_s=None)]
    store.write_walks(tmp_path / "a.csv.gz", walks)
    assert store.read_walks(tmp_path / "a.csv.gz") == walks
    store.write_walks(tmp_path / "b.csv.gz", walks)
    assert (tmp_path / "a.csv.gz").read_bytes() == (tmp_path / "b.csv.gz").read_bytes()


def test_a_tuned_file_tells_its_searches(tmp_path: Path) -> None:
    file, first = tmp_path / "dog.toml", "# Imported from dog.urdf.\n"
    file.write_text(first)
    assert store.searches_of(file) == {}
    first = (
        f"# Tuned by apnc tune read/dog.toml --candidates 96 --seed 1, version 0.1.0.\n\n{first}"
    )
    file.write_text(first)
    assert store.searches_of(file) == {
        "commands": ["apnc tune dog.toml --candidates 96 --seed 1"], "candidates": 96
    }  # fmt: skip
    second = "# Tuned by apnc tune pup.toml --candidates 32 --seed 1 --near, version 0.1.0.\n\n"
    file.write_text(second + first)
    assert store.searches_of(file) == {
        "commands": [
            "apnc tune dog.toml --candidates 96 --seed 1 --output pup.toml",
            "apnc tune pup.toml --candidates 32 --seed 1 --near",
        ],
        "candidates": 128,
    }


def test_notes_of_a_robot_leave_the_others(tmp_path: Path) -> None:
    store.add_note(tmp_path, "dog", {"minutes": 3})
    store.add_note(tmp_path, "cat", {"minutes": 4})
    store.add_note(tmp_path, "dog", {"minutes": 5})
    assert store.notes_in(tmp_path) == {"dog": {"minutes": 5}, "cat": {"minutes": 4}}


@pytest.mark.skipif(not store.WALKS.exists(), reason="nothing was measured")
def test_the_page_in_the_documentation_is_that_of_the_stored_walks() -> None:
    from research.gallery.__main__ import PAGE, PICTURES  # noqa: PLC0415
    from research.gallery.robots import robots  # noqa: PLC0415

    text = page.text(
        robots(), store.read_json(store.ABOUT), store.read_walks(store.WALKS), PICTURES
    )
    assert PAGE.read_text("utf-8") == text


def test_the_front_pages_say_how_many_robots_reach_every_aim() -> None:
    text = (DOCS / "robots" / "gallery.md").read_text("utf-8")
    found = re.search(r"\*\*(\d+ of \d+) robots reach every aim", text)
    assert found
    for front in (DOCS.parent / "README.md", DOCS / "index.md"):
        assert re.search(rf"- {found[1]} \[?robots of other people", front.read_text("utf-8"))
