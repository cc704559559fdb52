#!/usr/bin/env python3
"""Mutation testing of the safety core: changes one thing at a time in a copy of the sources, builds the test programs
that matter, and says which changes no test noticed. See README.md; run by `./dev mutants`."""
import argparse
import os
import random
import shutil
import subprocess
import sys
import time
from pathlib import Path

sys.dont_write_bytecode = True  # the sources stay as they are
from changes import changes_in  # noqa: E402
from programs import PROGRAMS, order_for, write_ninja  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
DEFAULT_PATHS = ["common/safety", "common/params", "firmware/app"]
BAR = 0.9
COPIED = ["common", "firmware/app", "hal", "host", "tests"]


def read_equivalents(path):
    """Blocks of four lines: file, "- line", "+ changed line", "= why nobody can tell the difference"."""
    known = {}
    lines = [line for line in path.read_text().splitlines() if line and not line.startswith("#")]
    for at in range(0, len(lines), 4):
        file, before, after, why = lines[at:at + 4]
        if not (before.startswith("- ") and after.startswith("+ ") and why.startswith("= ")):
            sys.exit(f"{path}: cannot read the block that begins with '{file}'")
        known[(file, before[2:], after[2:])] = why[2:]
    return known


def sources_in(paths):
    files = []
    for path in paths:
        full = ROOT / path
        if full.is_file():
            files.append(path)
        elif full.is_dir():
            files += sorted(str(f.relative_to(ROOT)) for f in full.rglob("*") if f.suffix in (".cpp", ".hpp"))
        else:
            sys.exit(f"./dev mutants: there is no {path}")
    return files


class Bench:
    """A copy of the sources with a build of its own, in which one change at a time is made and undone."""

    def __init__(self, folder, jobs, programs):
        self.folder, self.jobs, self.programs = folder, jobs, programs
        self.seconds = {}
        folder.mkdir(parents=True, exist_ok=True)
        for part in COPIED:
            self._copy(part)
        write_ninja(folder)

    def _copy(self, part):
        """Only what differs, so that the next run builds only that."""
        wanted = set()
        for source in (ROOT / part).rglob("*"):
            if source.suffix not in (".cpp", ".hpp"):
                continue
            relative = source.relative_to(ROOT)
            wanted.add(relative)
            target = self.folder / relative
            if target.exists() and target.read_bytes() == source.read_bytes():
                continue
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, target)
        for target in (self.folder / part).rglob("*.?pp"):
            if target.relative_to(self.folder) not in wanted:
                target.unlink()

    def order_for(self, file):
        return [program for program in order_for(file) if program in self.programs]

    def build(self, program):
        return subprocess.run(["ninja", "-C", str(self.folder), f"-j{self.jobs}", program], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, check=False)

    def passes(self, program):
        """Endless loops count as a failure: ten times the time without a change, and at least ten seconds."""
        limit_s = max(10.0, 10 * self.seconds.get(program, 60.0))
        started = time.monotonic()
        try:
            done = subprocess.run(["./" + program, "--gtest_fail_fast", "--gtest_brief=1"], cwd=self.folder,
                                  env={**os.environ, "RC_PARAMS": "seed=20240711"}, timeout=limit_s,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
                                  check=False)
        except subprocess.TimeoutExpired:
            return False, "it did not end"
        if done.returncode == 0:
            self.seconds.setdefault(program, time.monotonic() - started)
            return True, ""
        failed = [line for line in done.stdout.splitlines() if line.startswith("[  FAILED  ] ")]
        return False, failed[0][13:].split(" (")[0].split(",")[0] if failed else f"ended with {done.returncode}"

    def prove_sound(self, programs):
        for program in programs:
            built = self.build(program)
            if built.returncode != 0:
                sys.exit(built.stdout + f"./dev mutants: {program} does not build without any change")
            passed, why = self.passes(program)
            if not passed:
                sys.exit(f"./dev mutants: {program} fails without any change: {why}")
            print(f"{program}: passes in {self.seconds[program]:.1f} s", flush=True)

    def verdict(self, change):
        """("killed", by which test), ("survived", ""), or ("invalid", "") if the change is no program."""
        file = self.folder / change.file
        sound = file.read_text()
        file.write_text(change.apply(sound))
        try:
            for program in self.order_for(change.file):
                built = self.build(program)
                if built.returncode != 0:
                    return "invalid", ""
                passed, why = self.passes(program)
                if not passed:
                    return "killed", f"{program}: {why}"
            return "survived", ""
        finally:
            file.write_text(sound)


def main():
    parser = argparse.ArgumentParser(prog="./dev mutants", description=__doc__)
    parser.add_argument("paths", nargs="*", default=DEFAULT_PATHS, help="folders and files, from the root")
    parser.add_argument("--seed", type=int, default=1, help="which sample")
    parser.add_argument("--count", type=int, default=150, help="how many changes; 0: all")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="compilers at once")
    parser.add_argument("--programs", nargs="+", choices=PROGRAMS, default=PROGRAMS,
                        help="only these; without robot a change is judged in seconds, by fewer tests")
    parser.add_argument("--list", action="store_true", help="only show the changes that would be made")
    parser.add_argument("--folder", default=str(ROOT / "build" / "mutants"), help="where to build")
    options = parser.parse_args()

    equivalents = read_equivalents(Path(__file__).with_name("equivalent.txt"))
    pick = random.Random(options.seed)
    sites = [site for file in sources_in(options.paths) for site in changes_in(file, (ROOT / file).read_text())]
    pick.shuffle(sites)
    bench = None
    if not options.list:
        bench = Bench(Path(options.folder), options.jobs, options.programs)
        needed = {p for site in sites for p in bench.order_for(site[0].file)}
        bench.prove_sound([p for p in PROGRAMS if p in needed])

    # Sites are drawn one by one, since those whose change is equivalent or no program do not count; neighbours in one
    # file are tried together, so that the build has less to undo.
    wanted = options.count or len(sites)
    results, drawn = [], 0
    while drawn < len(sites) and len(results) < wanted:
        batch = []
        while drawn < len(sites) and len(batch) < wanted - len(results):
            change = pick.choice(sites[drawn])
            drawn += 1
            if change.key() not in equivalents:
                batch.append(change)
        for change in sorted(batch, key=lambda c: (c.file, c.line)):
            if options.list:
                verdict, by = "", ""
            else:
                verdict, by = bench.verdict(change)
            if verdict == "invalid":
                continue
            results.append((change, verdict))
            print(f"{verdict:8}  {change.file}:{change.line}  {change.kind}  {by}\n"
                  f"    - {change.before}\n    + {change.after}", flush=True)
    if options.list:
        return 0

    survived = [change for change, verdict in results if verdict == "survived"]
    killed = len(results) - len(survived)
    print(f"\nseed {options.seed}: {killed} of {len(results)} killed"
          f" ({100 * killed / max(1, len(results)):.1f} %), {len(survived)} survived;"
          f" {len(equivalents)} known equivalents left out")
    for file in sorted({change.file for change, _ in results}):
        mine = [verdict for change, verdict in results if change.file == file]
        print(f"  {file:40} {mine.count('killed'):4} of {len(mine):4}")
    if survived:
        print("\nsurvivors:")
    for change in survived:
        print(f"{change.file}\n- {change.before}\n+ {change.after}\n")
    return 0 if killed >= BAR * len(results) else 1


if __name__ == "__main__":
    sys.exit(main())
