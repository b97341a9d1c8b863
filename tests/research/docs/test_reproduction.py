"""The page of the paper's claims: verdicts, words and figures belong together."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest

from research.docs import reproduction
from research.docs.reproduction import (
    VERDICTS,
    counts,
    details,
    measured,
    put_sentence,
    sentence,
    table,
    verdicts,
)

CLAIMS = """- commit: abc

| paper says | where | measured | verdict |
|---|---|---|---|
| it walks | 3.1 | strict: 1.2 s; 2 of 3; authors': 0.8 s | **partly** |
| it stops | 3.2 | 20/20 | **reproduced** |
"""
PARTLY = {"where": "3.1", "claim": "it walks", "verdict": "partly", "short": "Some.", "why": "Ice."}
YES = {"where": "3.2", "claim": "it stops", "verdict": "reproduced", "short": "In every run."}


def test_each_claim_has_its_line_and_its_section() -> None:
    found = verdicts(CLAIMS, [YES, PARTLY])
    assert table(found).splitlines()[2:] == [
        "| [it walks](reproduction/claims.md#claim-1) (3.1) | **partly** | Some. |",
        "| [it stops](reproduction/claims.md#claim-2) (3.2) | **reproduced** | In every run. |",
    ]
    assert "| reproduced | partly | all |" in counts(found)
    assert "| 1 | 1 | 2 |" in counts(found)
    page = details(found)
    assert page.index("Ice.") < page.index("    - 1.2 s") < page.index("    - 0.8 s")
    assert page.index('<a id="claim-2"></a>It stops') < page.index("- 20/20")


def test_criteria_have_lists_of_their_own() -> None:
    assert measured("imposed; strict: 1 s; 2 s; authors': 3 s").splitlines() == [
        "- imposed",
        "- By the strict criterion:",
        "    - 1 s",
        "    - 2 s",
        "- By the authors' criterion:",
        "    - 3 s",
    ]


@pytest.mark.parametrize(
    ("reasons", "said"),
    [
        ([YES], "'it walks' .* no words"),
        ([YES, PARTLY | {"verdict": "not"}], "'it walks' .* 'partly': .* words for 'not'"),
        ([YES, PARTLY | {"why": ""}], "'it walks' .* its reason is missing"),
        ([YES | {"why": "Luck."}, PARTLY], "'it stops' .* its reason is left over"),
        ([YES, PARTLY, YES | {"claim": "it flies"}], "no such claims: .*it flies"),
    ],
)
def test_words_without_their_verdict_are_refused(reasons: list[dict[str, str]], said: str) -> None:
    with pytest.raises(ValueError, match=said):
        verdicts(CLAIMS, reasons)


def test_the_pages_show_the_words_of_the_file() -> None:
    page = reproduction.PAGE.read_text("utf-8")
    shown = re.findall(
        r"(?m)^\| \[(.*)\]\(.*#claim-\d+\) \((.*)\) \| \*\*(.*)\*\* \| (.*) \|$", page
    )
    words = tomllib.loads(Path(reproduction.REASONS).read_text("utf-8"))["reason"]
    assert len(shown) == len(words) > 30
    assert shown == [(e["claim"], e["where"], e["verdict"], e["short"]) for e in words]
    count = [sum(e["verdict"] == verdict for e in words) for verdict in VERDICTS]
    assert f"| {' | '.join(map(str, [*filter(None, count), len(words)]))} |" in page
    assert reproduction.DETAILS.read_text("utf-8").count('<a id="claim-') == len(words)
    for counted in reproduction.COUNTED:
        assert sentence(e["verdict"] for e in words) in counted.read_text("utf-8")


def test_the_sentence_that_counts_is_put_once() -> None:
    text = sentence(["partly", "reproduced", "partly", "not"])
    assert text.endswith("check: 1 reproduced, 2 partly, 1 not, 0 without a verdict")
    page = f"It makes {sentence(['not'] * 12)} (here)."
    assert put_sentence(page, text) == f"It makes {text} (here)."
    with pytest.raises(ValueError, match="is there 2 times"):
        put_sentence(page + page, text)
