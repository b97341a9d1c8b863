"""Where trials run: on this machine's cores or on a Dask cluster, behind one interface."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Protocol

import joblib

from apnc.studies.evaluation.trial import Row, Trial, run_trial


class Workers(Protocol):
    """Runs trials and yields their rows as they finish, in any order."""

    def rows(self, trials: Sequence[Trial], series: Path | None) -> Iterator[Row]:
        """Rows of all trials."""


class LocalWorkers:
    """Processes on this machine.

    Args:
        count: number of processes; 1 runs in this one.
    """

    def __init__(self, count: int) -> None:
        self.count = count

    def rows(self, trials: Sequence[Trial], series: Path | None) -> Iterator[Row]:
        """Rows of all trials, as they finish."""
        parallel = joblib.Parallel(n_jobs=self.count, return_as="generator_unordered")
        yield from parallel(joblib.delayed(run_trial)(trial, series) for trial in trials)


class DaskWorkers:
    """A Dask cluster.

    Args:
        address: of its scheduler, such as ``tcp://127.0.0.1:8786``.

    Raises:
        ValueError: the extra ``cluster`` is missing, or there is no scheduler at the address.
    """

    def __init__(self, address: str) -> None:
        try:
            from dask.distributed import Client  # noqa: PLC0415  # an extra
        except ImportError:
            raise ValueError(
                "--scheduler needs the extra 'cluster': pip install 'apnc[cluster]'"
            ) from None
        try:
            self.client = Client(address, timeout="10s")
        except (OSError, ValueError) as error:
            raise ValueError(f"no Dask scheduler at {address}: {error}") from None

    def rows(self, trials: Sequence[Trial], series: Path | None) -> Iterator[Row]:
        """Rows of all trials, as they finish; a lost worker's trials run elsewhere."""
        from dask.distributed import as_completed  # noqa: PLC0415  # an extra

        futures = self.client.map(
            run_trial, trials, series=series, key=[t.key for t in trials], retries=3, pure=True
        )
        try:
            for future in as_completed(futures):
                yield future.result()
                future.release()
        finally:
            self.client.cancel(futures)
            self.client.close()


def workers(count: int, scheduler: str | None) -> Workers:
    """The workers asked for.

    Args:
        count: processes on this machine, if no scheduler is given.
        scheduler: address of a Dask scheduler, or None.

    Raises:
        ValueError: fewer than one process, or no such scheduler.
    """
    if scheduler:
        return DaskWorkers(scheduler)
    if count < 1:
        raise ValueError(f"workers = {count} is not at least 1")
    return LocalWorkers(count)
