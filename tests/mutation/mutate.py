"""Tries random mutants of the kernels and the host code: which do the tests let pass? See mutate.sh."""
import argparse
import difflib
import json
import os
import queue
import random
import re
import signal
import subprocess
import sys
import threading
import time
from collections import Counter, defaultdict

import operators
import reached
import trial

PROJECT = os.path.realpath(os.path.join(os.path.dirname(__file__), "..", ".."))
BUILD = f"{PROJECT}/build/tests"
EQUIVALENT = f"{PROJECT}/tests/mutation/equivalent.txt"
# Data, no other value of which would be wrong: scenes and their textures as they are drawn, the cases
# and inputs that 'validate' tries (faults_tests show that they find what they are for), and roughly
# what a case costs. And what builds the kernels in four ways: its tests (--full) take minutes.
NOT_MUTATED = ("host/scenes/builtin/", "host/scenes/geometry/texture.cpp", "host/splat/clouds/models.cpp",
               "host/validation/grid.cpp", "host/validation/input.cpp", "host/validation/patterns_input.cpp",
               "host/validation/splat_input.cpp", "host/validation/stage_input.cpp",
               "host/validation/work.cpp", "host/validation/arithmetic.cpp",
               "cli/validate/validate_arithmetic.cpp", "cli/main.cpp")


def sources(folder):
    files = subprocess.run(["git", "-C", PROJECT, "ls-files", "kernels", "host", "cli"], capture_output=True,
                           text=True, check=True).stdout.split()
    wanted = [f for f in files if f.endswith((".cl", ".clh", ".cpp", ".h")) and not f.startswith(NOT_MUTATED)]
    found = [f for f in wanted if f.startswith(folder.rstrip("/") + "/") or f == folder] if folder else wanted
    if not found:
        sys.exit(f"mutate.sh: --in '{folder}' holds none of the kernels, host or cli")
    return found


def all_mutants(folder, build):
    """Places in the order of the files; each holds its mutants."""
    places = {}
    for path in sources(folder):
        if not 0 < len(build.sources_of(path)) <= trial.OBJECTS:
            continue
        for mutant in operators.mutants_of(path, text_of(path)):
            places.setdefault((path, mutant.begin), []).append(mutant)
    return list(places.values())


def text_of(path):
    return open(f"{PROJECT}/{path}").read()


def equivalents():
    """(path, line as it is, line as mutated), stripped; several lines as mutated may follow one."""
    found = set()
    blocks = open(EQUIVALENT).read().split("\n\n")
    for block in blocks:
        lines = [l for l in block.split("\n") if l and not l.startswith("#")]
        for mutated in lines[2:]:
            if mutated.startswith("+ "):
                found.add((lines[0].strip(), lines[1][1:].strip(), mutated[1:].strip()))
    return found


def changed_lines(mutant):
    source = text_of(mutant.path)
    before, after = source.split("\n"), mutant.apply(source).split("\n")
    at = mutant.line(source) - 1
    span = source.count("\n", mutant.begin, mutant.end) + 1
    left = len(before) - at - span
    return " ".join(l.strip() for l in before[at:at + span]), " ".join(
        l.strip() for l in after[at:len(after) - left])


def folder_of(path):
    parts = path.split("/")
    return "/".join(parts[:2]) if parts[0] == "host" and len(parts) > 2 else parts[0]


def launchers(kernel_file):
    """Kernels of a file, or of those that include it, and the host files that launch them."""
    wanted = {kernel_file.removeprefix("kernels/")}
    texts = {f.removeprefix("kernels/"): text_of(f) for f in sources("kernels")}
    for _ in texts:
        wanted |= {f for f, text in texts.items() for w in wanted if f'#include "{w}"' in text or f'#include "kernels/{w}"' in text}
    kernels = sorted({k for f in wanted if f.endswith(".cl") for k in re.findall(r"__kernel void (\w+)\(", texts[f])})
    files = [f for f in sources("host") if f.endswith(".cpp") and "validation" not in f
             and any(f'"{k}"' in text_of(f) for k in kernels)]
    return kernels, files


class Run:
    def __init__(self, arguments):
        self.build = trial.Build(PROJECT, BUILD)
        self.budget = arguments.budget
        self.reached = reached.Reached(PROJECT, BUILD)
        self.known = equivalents()
        places = all_mutants(arguments.folder, self.build)
        if arguments.only:
            named = [m for place in places for m in place if m.name(text_of(m.path)) == arguments.only]
            if not named:
                sys.exit(f"mutate.sh: there is no mutant {arguments.only} (any more)")
            self.mutants = named[:1]
        else:
            chance = random.Random(arguments.seed)
            chosen = chance.sample(places, min(max(arguments.count, arguments.most), len(places)))
            self.mutants = [chance.choice(place) for place in chosen]
        name = re.sub(r"\W+", "_", f"{arguments.seed} {arguments.folder}")
        self.log = f"{BUILD}/mutants/{name}.jsonl"
        os.makedirs(os.path.dirname(self.log), exist_ok=True)
        self.done = {}
        if os.path.exists(self.log) and not arguments.only and not arguments.fresh:
            for line in open(self.log):
                entry = json.loads(line)
                self.done[entry["mutant"], entry["after"]] = entry
        elif not arguments.only:
            open(self.log, "w").close()
        self.is_logged = not arguments.only
        self.count, self.least = min(arguments.count, len(self.mutants)), arguments.least
        self.lock = threading.Lock()
        self.results = []
        self.workers = [trial.Worker(self.build, f"{BUILD}/mutants/worker-{i}") for i in range(arguments.jobs)]

    def try_one(self, worker, mutant):
        source = text_of(mutant.path)
        kernels = []
        if mutant.path.startswith("kernels/"):
            kernels, files = launchers(mutant.path)
            near = set().union(*(self.reached.by_path[f] for f in files))
            far = near
        else:
            near, far = self.reached.of_line(mutant.path, mutant.line(source))
            if mutant.path.endswith(".h"):
                far = far.union(*(self.reached.by_path[f] for unit in self.build.sources_of(mutant.path)
                                  for f in self.build.members[unit]))
        return trial.try_mutant(worker, mutant.path, mutant.apply(source), near, far, self.reached.tests, kernels, self.budget)

    def note(self, mutant, outcome, seconds, is_new):
        before, after = changed_lines(mutant)
        name = mutant.name(text_of(mutant.path))
        if outcome.startswith("survived") and (mutant.path, before, after) in self.known:
            outcome = "equivalent"
        entry = {"mutant": name, "before": before, "after": after, "outcome": outcome, "seconds": round(seconds, 1)}
        with self.lock:
            self.results.append((mutant, entry))
            print(f"[{len(self.results)}/{self.count}] {name}: {outcome} ({seconds:.0f} s)", flush=True)
            if outcome.startswith("survived"):
                print(f"    - {before}\n    + {after}\n    again: tests/mutate.sh --only '{name}'", flush=True)
            if is_new and self.is_logged:
                with open(self.log, "a") as log:
                    log.write(json.dumps(entry) + "\n")

    def work(self, worker, waiting):
        while not worker.stopped:
            try:
                mutant = waiting.get_nowait()
            except queue.Empty:
                return
            begin = time.time()
            before, after = changed_lines(mutant)
            known = self.done.get((mutant.name(text_of(mutant.path)), after))
            try:
                if known:
                    outcome = known["outcome"]
                else:
                    outcome = "equivalent" if (mutant.path, *changed_lines(mutant)) in self.known else self.try_one(worker, mutant)
            except KeyboardInterrupt:
                return
            self.note(mutant, outcome, known["seconds"] if known else time.time() - begin, not known)

    def run(self):
        """Whether all were tried: --count, then one by one up to --most while there is no score, or one below --least."""
        finished = self.try_all(self.mutants[:self.count])
        while finished and self.score(if_none=0) < self.least and self.count < len(self.mutants):
            self.count += 1
            finished = self.try_all(self.mutants[self.count - 1:self.count])
        if not finished:
            print(f"Interrupted: {len(self.results)} of {self.count} are noted; the same command goes on.")
        self.summary()
        return finished

    def try_all(self, mutants):
        waiting = queue.Queue()
        for mutant in mutants:
            waiting.put(mutant)
        threads = [threading.Thread(target=self.work, args=(w, waiting)) for w in self.workers]
        for thread in threads:
            thread.start()
        try:
            for thread in threads:
                while thread.is_alive():
                    thread.join(0.2)
        except KeyboardInterrupt:
            for worker in self.workers:
                worker.stop()
            for thread in threads:
                thread.join()
        return len(self.results) == self.count

    def summary(self):
        rows = defaultdict(Counter)
        for mutant, entry in self.results:
            kind = entry["outcome"].split(" in ")[0].split(" by ")[0]
            kind = "survived" if kind.startswith("survived") else kind
            for folder in (folder_of(mutant.path), "kernels, all" if mutant.path.startswith("kernels") else "host, all"):
                rows[folder][kind] += 1
        print(f"{'folder':18} killed  timed out  survived  equivalent  does not compile   score")
        for folder in sorted(rows):
            r = rows[folder]
            dead = r["killed"] + r["timed out"]
            tried = dead + r["survived"]
            score = f"{100 * dead / tried:5.1f} %" if tried else "    –"
            print(f"{folder:18} {r['killed']:6}  {r['timed out']:9}  {r['survived']:8}  {r['equivalent']:10}  {r['does not compile']:16}  {score}")

    def score(self, if_none=100):
        """Per cent killed of those that could be."""
        outcomes = [entry["outcome"] for _, entry in self.results]
        dead = sum(o.startswith(("killed", "timed out")) for o in outcomes)
        tried = dead + sum(o.startswith("survived") for o in outcomes)
        return 100 * dead / tried if tried else if_none


def main():
    parser = argparse.ArgumentParser(prog="tests/mutate.sh", description=__doc__)
    parser.add_argument("--count", type=int, default=50, help="how many mutants (50)")
    parser.add_argument("--seed", type=int, default=1, help="which ones (1)")
    parser.add_argument("--in", dest="folder", default="", help="only those of a folder or a file: host/rdb")
    parser.add_argument("--only", help="this one alone, as an earlier run names it")
    parser.add_argument("--fresh", action="store_true", help="try again what an earlier run of the same seed has tried")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="how many at once (all cores)")
    parser.add_argument("--budget", type=float, default=trial.BUDGET, help="share of a mutant's tests to try, by time (1/3)")
    parser.add_argument("--least", type=float, default=100, help="exit with 1 below this score, per cent (100)")
    parser.add_argument("--most", type=int, default=0, help="try further ones, up to this many, while the score is below --least (none)")
    arguments = parser.parse_args()
    run = Run(arguments)
    finished = run.run()
    return 130 if not finished else 1 if run.score() < arguments.least else 0


if __name__ == "__main__":
    sys.exit(main())
