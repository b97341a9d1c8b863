"""Verdicts of claims from one group of seeds after another."""

from __future__ import annotations

from research.docs.verdicts import GROUPS, SEEDS, table, trials_of


def test_every_group_has_the_grid_of_a_study_with_seeds_of_its_own() -> None:
    trials = trials_of("damage")
    for controller, count in (("apnc", SEEDS), ("tegotae", SEEDS // 2)):
        seeds = sorted(t.cell["seed"] for t in trials if t.cell["controller"] == controller)
        assert seeds == [SEEDS * group + seed for group in range(GROUPS) for seed in range(count)]
        assert all(t.experiment.seed == t.cell["seed"] for t in trials)


def test_the_table_has_the_claims_whose_verdict_changes() -> None:
    lines = [
        {"seeds": seeds, "where": "3.1", "claim": claim, "verdict": verdict}
        for claim, verdicts in {"firm": "not not not", "loose": "partly not partly"}.items()
        for seeds, verdict in zip(
            ("0 to 19", "20 to 39", "40 to 59"), verdicts.split(), strict=True
        )
    ]
    assert table(lines).splitlines() == [
        "| claim | where | seeds 0 to 19 | reproduced | partly | not |",
        "| --- | --- | --- | --- | --- | --- |",
        "| loose | 3.1 | partly | 0 | 2 | 1 |",
    ]
