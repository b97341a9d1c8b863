"""Jobs for the table of trials, in a module that worker processes can import."""

from __future__ import annotations

from dataclasses import dataclass

from apnc.studies.trial_table import Row


@dataclass(frozen=True)
class Job:
    number: int


def square(job: Job) -> Row:
    if job.number == 3:
        raise RuntimeError("three, of all numbers")
    return {"number": job.number, "square": job.number**2}


JOBS = [Job(n) for n in (3, 1, 2, 5)]
