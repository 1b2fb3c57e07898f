#!/usr/bin/env python3
"""Measures the service as its users meet it, over HTTP, and prints a table: what, target, measured, verdict.

usage: service.py [--quick] [--only NAME,...] [--json FILE] [--build FOLDER] [--folder FOLDER]

Run it from the root of the repository after a build. bench/README.md says what each figure means. Standard library only.
"""

import argparse
import contextlib
import hashlib
import json
import os
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from dataclasses import asdict, dataclass
from pathlib import Path

HOUNDS = ("hound/stand", "hound/bow", "hound/look", "hound/stride", "hound/sit")
IMPS = ("imp/stand", "imp/crouch", "imp/run", "imp/wave", "imp/dance")
FIVE = (*HOUNDS[:3], *IMPS[:2])
RUNS = 5
MOST_VERTICES = 1_000_000


@dataclass
class Row:
    """One line of the table."""

    what: str
    measured: float
    unit: str
    at_most: float | None  # nothing where there is no target
    detail: str = ""

    def verdict(self) -> str:
        if self.at_most is None:
            return ""
        return "ok" if self.measured <= self.at_most else "MISSED"

    def cells(self) -> tuple[str, ...]:
        target = "" if self.at_most is None else f"{self.at_most:g} {self.unit}"
        return self.what, target, f"{self.measured:.3g} {self.unit}", self.verdict(), self.detail


class Bench:
    """The programs, the meshes, a folder for stores, and the rows found so far."""

    def __init__(self, support, build: Path, folder: Path, quick: bool):
        self.support, self.build, self.folder, self.quick = support, build, folder, quick
        self.rows: list[Row] = []
        self.large, self.small = (10_000, 2_000) if quick else (50_000, 5_000)
        self.huge = 50_000 if quick else 500_000

    def add(self, what: str, measured: float, unit: str, at_most: float | None = None, detail: str = "") -> None:
        """A quick run is of other sizes, so that no target applies to its times."""
        row = Row(what, measured, unit, None if self.quick and unit in ("s", "MiB") else at_most, detail)
        self.rows.append(row)
        print("  ".join(cell for cell in row.cells() if cell), flush=True)

    def mesh(self, sample: str, vertices: int) -> bytes:
        """A sample grown or shrunk to a size, kept for the next time."""
        file = self.folder / f"{sample.replace('/', '-')}-{vertices}.off"
        if not file.exists():
            subprocess.run([self.build / "bin/spherematch-bench", "grow", f"samples/{sample}.off", file, str(vertices)], check=True)
        return file.read_bytes()

    def store(self, name: str) -> str:
        """The path of a store that does not exist yet."""
        for file in self.folder.glob(f"{name}.db*"):
            file.unlink()
        return str(self.folder / f"{name}.db")

    @contextlib.contextmanager
    def server(self, store: str, *flags: str):
        server = self.support.Server(store, "--max-vertices", str(MOST_VERTICES), "--max-body-mib", "200", "--log-level", "warn", *flags)
        try:
            yield server
        finally:
            server.stop()


def upload(server, mesh: bytes, name: str = "") -> str:
    response = server.post(mesh, name=name) if name else server.post(mesh)
    assert response.status in (200, 201, 202), response.body
    return response.json()["id"]


def finished(server, shape: str, pause: float = 0.05) -> dict:
    """The shape once it is ready."""
    while True:
        answer = server.get(f"/shapes/{shape}").json()
        if answer["state"] == "ready":
            return answer
        assert answer["state"] in ("queued", "processing"), answer
        time.sleep(pause)


def prepare(server, mesh: bytes) -> dict:
    return finished(server, upload(server, mesh))


def match_path(source: str, target: str, *more: str) -> str:
    return "&".join((f"/match?src={source}&tgt={target}&format=npz", *more))


def timed_get(server, path: str, headers: dict | None = None) -> tuple[float, object]:
    """Seconds from the start of the connection to the last byte, and the response."""
    start = time.perf_counter()
    response = server.request("GET", path, headers=headers)
    return time.perf_counter() - start, response


def timed_match(server, source: str, target: str) -> float:
    seconds, response = timed_get(server, match_path(source, target, "cache=no"))
    assert response.status == 200, response.body[:300]
    return seconds


def peak_mib(process: int) -> float:
    """Nought once the process is gone."""
    with contextlib.suppress(OSError), open(f"/proc/{process}/status", encoding="ascii") as status:
        for line in status:
            if line.startswith("VmHWM:"):
                return int(line.split()[1]) / 1024
    return 0


def listed(values) -> str:
    return "of " + ", ".join(f"{value:.3g}" for value in values)


# What is measured


def measure_preparation(bench: Bench) -> None:
    """Five shapes, one after the other, on an idle server."""
    for vertices, target in ((bench.large, 3.0), (bench.small, 0.5)):
        with bench.server(bench.store("preparation")) as server:
            totals = [prepare(server, bench.mesh(sample, vertices))["seconds"]["total"] for sample in FIVE]
        bench.add(f"preparation, {vertices} vertices", statistics.median(totals), "s", target, listed(totals))


def measure_match(bench: Bench) -> None:
    """Whole requests for a map that nobody has computed, and the same as the first request of a server."""
    for vertices, target in ((bench.large, 0.80), (bench.small, 0.20)):
        store = bench.store("match")
        pairs = {}
        with bench.server(store) as server:
            for kind, samples in (("hounds", HOUNDS[:2]), ("imps", IMPS[:2])):
                pairs[kind] = [prepare(server, bench.mesh(sample, vertices))["id"] for sample in samples]
                timed_match(server, *pairs[kind])  # brings both shapes into memory
                times = [timed_match(server, *pairs[kind]) for _ in range(RUNS)]
                bench.add(f"match of two {kind}, {vertices} vertices", statistics.median(times), "s", target, listed(times))
        for kind, pair in pairs.items():
            extra = []
            for _ in range(RUNS):
                with bench.server(store) as server:
                    first = timed_match(server, *pair)
                    extra.append(first - timed_match(server, *pair))
            what = f"first match after a restart, more than the second, {kind}, {vertices}"
            bench.add(what, statistics.median(extra), "s", 0.15, listed(extra))


def measure_batch(bench: Bench) -> None:
    """From the first upload to the last result."""
    meshes = [bench.mesh(sample, bench.large) for sample in (*HOUNDS, *IMPS)]
    with bench.server(bench.store("batch")) as server:
        start = time.perf_counter()
        shapes = [upload(server, mesh) for mesh in meshes]
        pairs = [[a, b] for i, a in enumerate(shapes) for b in shapes[i + 1 :]]
        job = server.request("POST", "/match", body=json.dumps({"pairs": pairs, "both": True}).encode()).json()
        for shape in shapes:
            finished(server, shape, pause=0.2)
        prepared = time.perf_counter() - start
        with server.stream(job["results"], timeout=36000) as results:
            lines = [json.loads(line) for line in results]
        seconds = time.perf_counter() - start
    assert len(lines) == len(pairs) and all("match" in line for line in lines), [line for line in lines if "match" not in line][:1]
    bench.add(
        f"{len(shapes)} shapes of {bench.large} and their {len(pairs)} pairs, both directions", seconds, "s", 60, f"prepared by {prepared:.3g} s"
    )


def measure_huge(bench: Bench) -> None:
    mesh = bench.mesh(HOUNDS[0], bench.huge)
    with bench.server(bench.store("huge")) as server:
        start = time.perf_counter()
        shape = upload(server, mesh)
        uploaded = time.perf_counter() - start
        worker = 0.0
        answer = {"state": "queued"}
        while answer["state"] in ("queued", "processing"):
            worker = max([worker, *(peak_mib(process) for process in server.preparations())])
            answer = server.get(f"/shapes/{shape}").json()
            time.sleep(0.02)
        assert answer["state"] == "ready", answer
        wall = time.perf_counter() - start
        own = peak_mib(server.process.pid)
    total = answer["seconds"]["total"]
    bench.add(f"preparation, {bench.huge} vertices", total, "s", 40, f"upload {uploaded:.3g} s, from upload to ready {wall:.3g} s")
    bench.add(f"peak memory of the preparation's process, {bench.huge}", worker, "MiB", 2560)
    bench.add(f"peak memory of the server, {bench.huge}", own, "MiB", 2560)


def measure_cached(bench: Bench) -> None:
    """Latencies of a client that comes alone, and of 32 at once."""
    with bench.server(bench.store("cached")) as server:
        pair = [prepare(server, bench.mesh(sample, bench.large))["id"] for sample in HOUNDS[:2]]
        path = match_path(*pair)
        tag = server.get(path).headers["ETag"]
        for name, headers, status, target in (("kept result as NPZ", {}, 200, 0.05), ("unchanged, 304", {"If-None-Match": tag}, 304, 0.01)):
            times = []
            for _ in range(200):
                seconds, response = timed_get(server, path, headers)
                assert response.status == status
                times.append(seconds)
            times.sort()
            bench.add(f"{name}, {bench.large}", times[100], "s", target, f"99 of 100 within {times[197]:.3g} s")

        def several() -> None:
            for _ in range(25):
                assert timed_get(server, path)[1].status == 200

        clients = [threading.Thread(target=several) for _ in range(32)]
        start = time.perf_counter()
        for client in clients:
            client.start()
        for client in clients:
            client.join()
        rate = 32 * 25 / (time.perf_counter() - start)
    bench.add(f"kept results to 32 clients, {bench.large}", 1000 / rate, "ms each", None, f"{rate:.0f} a second")


def wait_until(condition, what: str, most_seconds: float = 600) -> None:
    end = time.perf_counter() + most_seconds
    while not condition():
        if time.perf_counter() > end:
            raise TimeoutError(what)
        time.sleep(0.002)


def cancel_in_stage(server, mesh: bytes, stage: str) -> float | None:
    """Seconds from a DELETE in that stage until the preparation's process is gone; nothing where the stage was not seen."""
    shape = upload(server, mesh)
    while True:
        answer = server.get(f"/shapes/{shape}").json()
        if answer["state"] not in ("queued", "processing"):
            server.request("DELETE", f"/shapes/{shape}")
            return None
        if answer["stage"] == stage:
            break
        time.sleep(0.002)
    start = time.perf_counter()
    assert server.request("DELETE", f"/shapes/{shape}").status == 204
    wait_until(lambda: not server.preparations(), "the preparation's end")
    return time.perf_counter() - start


def measure_cancellation(bench: Bench) -> None:
    for vertices in (bench.large, bench.huge):
        with bench.server(bench.store("cancellation")) as server:
            stages = list(prepare(server, bench.mesh(HOUNDS[1], bench.small))["seconds"])
            mesh = bench.mesh(HOUNDS[0], vertices)
            found = {stage: cancel_in_stage(server, mesh, stage) for stage in stages if stage != "total"}
        seen = {stage: seconds for stage, seconds in found.items() if seconds is not None}
        detail = ", ".join(f"{stage} {seconds:.3g}" for stage, seconds in seen.items())
        missed = [stage for stage in found if stage not in seen]
        detail += f"; too short to be met: {', '.join(missed)}" if missed else ""
        bench.add(f"DELETE of a shape until its process is gone, {vertices}", max(seen.values()), "s", 0.5, detail)

    with bench.server(bench.store("cancellation")) as server:
        pair = [prepare(server, bench.mesh(sample, bench.large))["id"] for sample in HOUNDS[:2]]
        times = []
        # Each job asks for something else, since a match that ran to its end is kept. Cancelled right away, and a while after.
        for orientation, both, wait in (("preserve", False, 0), ("preserve", True, 0.1), ("any", False, 0.2), ("any", True, 0.05)):
            query = {"pairs": [pair, pair[::-1]], "orientation": orientation, "both": both}
            job = server.request("POST", "/match", body=json.dumps(query).encode()).json()
            wait_until(lambda: server.get("/healthz").json()["matches_running"] > 0, "the job's start")
            time.sleep(wait)
            start = time.perf_counter()
            assert server.request("DELETE", f"/jobs/{job['id']}").status == 202
            wait_until(lambda: server.get("/healthz").json()["matches_running"] == 0, "the job's end")
            times.append(time.perf_counter() - start)
    bench.add(f"DELETE of a job until nothing computes, {bench.large}", max(times), "s", 0.5, listed(times))


def measure_bytes(bench: Bench) -> None:
    """What the server answers with one thread and with two."""
    for vertices in (bench.small, bench.large):
        digests = []
        for threads in ("1", "2"):
            with bench.server(bench.store("bytes"), "--threads", threads) as server:
                pair = [prepare(server, bench.mesh(sample, vertices))["id"] for sample in HOUNDS[:2]]
                paths = [match_path(*pair, "both=yes", "cache=no")]
                paths += [f"/shapes/{shape}/{part}" for shape in pair for part in ("sphere", "hks")]
                digests.append([hashlib.sha256(server.get(path).body).hexdigest() for path in paths])
        different = sum(a != b for a, b in zip(*digests))
        bench.add(f"files that differ between 1 and 2 threads, {vertices}", different, "files", 0, f"of {len(digests[0])}")


MEASUREMENTS = {
    "preparation": measure_preparation,
    "match": measure_match,
    "batch": measure_batch,
    "huge": measure_huge,
    "cached": measure_cached,
    "cancellation": measure_cancellation,
    "bytes": measure_bytes,
}


def table_of(rows: list[Row]) -> str:
    lines = [("what", "at most", "measured", "", ""), *(row.cells() for row in rows)]
    widths = [max(len(line[i]) for line in lines) for i in range(4)]
    return "\n".join("  ".join([*(cell.ljust(width) for cell, width in zip(line, widths)), line[4]]).rstrip() for line in lines)


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Measures the service over HTTP.")
    parser.add_argument("--quick", action="store_true", help="small sizes, to see that everything runs; no targets")
    parser.add_argument("--only", default=",".join(MEASUREMENTS), help="which, separated by commas (default: %(default)s)")
    parser.add_argument("--json", type=Path, help="file for the results")
    parser.add_argument("--build", type=Path, default=Path("build"), help="where the programs are (default: %(default)s)")
    parser.add_argument("--folder", type=Path, help="keep meshes and stores here rather than in a folder that is removed")
    arguments = parser.parse_args()
    unknown = set(arguments.only.split(",")) - set(MEASUREMENTS)
    if unknown:
        parser.error(f"--only: unknown: {', '.join(sorted(unknown))}")
    return arguments


def main() -> int:
    arguments = parse_arguments()
    # The end-to-end tests' way to run a server.
    os.environ["SPHEREMATCH_SERVER"] = str(arguments.build / "bin/spherematch-server")
    os.environ["SPHEREMATCH_CLI"] = str(arguments.build / "bin/spherematch")
    sys.path.insert(0, str(Path(__file__).parent.parent / "tests/e2e"))
    import support

    folder = arguments.folder or Path(tempfile.mkdtemp(prefix="spherematch-bench-"))
    folder.mkdir(parents=True, exist_ok=True)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # so that its servers end with it
    bench = Bench(support, arguments.build, folder, arguments.quick)
    try:
        for name in arguments.only.split(","):
            MEASUREMENTS[name](bench)
            if arguments.json:
                arguments.json.write_text(json.dumps([asdict(row) for row in bench.rows], indent=1) + "\n", encoding="utf-8")
    finally:
        if arguments.folder is None:
            shutil.rmtree(folder)
    print("\n" + table_of(bench.rows))
    return 1 if any(row.verdict() == "MISSED" for row in bench.rows) else 0


if __name__ == "__main__":
    sys.exit(main())
