"""One mutant: compiled, linked and tried beside the build, which stays as it is."""
import json
import glob
import os
import re
import resource
import shutil
import signal
import subprocess
import threading
import time

PROGRAMS = ["kernels_tests", "host_tests", "command_tests", "properties_tests"]
# Shares of the time that all tests took when they noted what they reach: on a busy machine the same
# tests are tried as on an idle one.
BUDGET = 1 / 3          # of a mutant's tests, quickest first: a minute of three on two idle cores
QUICK = 1 / 20          # those that together take so much, 3 of 4 tests, go first
COMPILE_SECONDS = 300   # some take ten on an idle core
VALIDATE_SECONDS = 200  # of some kernels it takes twenty on idle cores
FAULTS_SECONDS = 900    # all faults; the next time, from the kernel cache, a third of it
OCLGRIND_SECONDS = 600  # of some kernels, under Oclgrind, it takes one to two minutes
HANGS = 30, 6           # seconds, and times the usual time, from where on tests count as hanging
# A header that more objects include is left out, frames and defaults among them, as it would take
# minutes each to compile.
OBJECTS = 12


class Build:
    """Commands of the build in build/tests."""

    def __init__(self, project, folder):
        self.project, self.folder = project, folder
        self.compile = {}   # path of what is compiled, maybe several sources in one (CMAKE_UNITY_BUILD): command
        self.members = {}   # the same path: its sources' paths in the project
        for entry in json.load(open(f"{folder}/compile_commands.json")):
            path, members = entry["file"], self._members(entry["file"])
            if members[0].startswith(("host/", "cli/")) and " -o tests/" not in entry["command"]:
                self.compile.setdefault(path, entry["command"])
                self.members.setdefault(path, members)
        self.compile.pop(f"{project}/cli/main.cpp", None)  # no library has it
        self.link = {program: self._ninja("-t", "commands", f"bin/{program}").strip().split("\n")[-1]
                     for program in PROGRAMS + ["defray", "faults_tests"]}
        self.included_by = {}
        self._read_dependencies()

    def _members(self, path):
        files = re.findall(r'^#include "(/.+)"', open(path).read(), re.M) if "/Unity/" in path else [path]
        return [os.path.relpath(file, self.project) for file in files]

    def _ninja(self, *arguments):
        return subprocess.run(["ninja", "-C", self.folder, *arguments], capture_output=True, text=True,
                              check=True).stdout.replace(f"ninja: Entering directory `{self.folder}'\n", "")

    def _read_dependencies(self):
        of_object = {re.search(r" -o (\S+)", command).group(1): path for path, command in self.compile.items()}
        source = None
        for line in self._ninja("-t", "deps").split("\n"):
            if line and not line.startswith(" "):
                source = of_object.get(line.split(":")[0])
            elif source:
                file = os.path.normpath(os.path.join(self.folder, line.strip()))
                path = os.path.relpath(file, self.project)
                if file.endswith("kernel_files.h"):
                    path = "kernel_files.h"
                if not path.startswith(".."):
                    self.included_by.setdefault(path, set()).add(source)

    def sources_of(self, path):
        """What must be compiled anew when a file changes."""
        if path.endswith(".cpp"):
            return [unit for unit in self.compile if path in self.members[unit]]
        found = set(self.included_by.get(path, ()))
        if path.startswith("kernels/"):
            found |= self.included_by.get("kernel_files.h", set())
        return sorted(found)


class Worker:
    """A folder to try one mutant after the other in."""

    def __init__(self, build, folder):
        self.build, self.folder = build, folder
        self.process = None
        self.stopped = False
        shutil.rmtree(folder, ignore_errors=True)
        os.makedirs(f"{folder}/bin")

    def stop(self):
        self.stopped = True
        process = self.process
        if process:
            try:
                os.killpg(process.pid, signal.SIGKILL)
            except ProcessLookupError:
                pass

    def run(self, command, seconds, environment=None, folder=None):
        """Exit code, or None when it took too long; and what it said."""
        if self.stopped:
            raise KeyboardInterrupt
        log = open(f"{self.folder}/log", "w+", errors="replace")
        self.process = subprocess.Popen(
            command, shell=isinstance(command, str), cwd=folder or self.build.folder, stdout=log, stderr=log,
            stdin=subprocess.DEVNULL, env={**os.environ, **(environment or {})}, start_new_session=True,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 30, 1 << 30)))
        try:
            code = self.process.wait(seconds)
        except subprocess.TimeoutExpired:
            code = None
        finally:
            try:
                os.killpg(self.process.pid, signal.SIGKILL)  # with all that it has started
            except ProcessLookupError:
                pass
            self.process.wait()
        if self.stopped:
            raise KeyboardInterrupt
        log.seek(0)
        return code, log.read()

    def compile(self, path, text):
        """Whether the mutant compiles; its objects lie in the worker's folder."""
        overlay = f"{self.folder}/overlay"
        shutil.rmtree(overlay, ignore_errors=True)
        os.makedirs(os.path.dirname(f"{overlay}/{path}"))
        with open(f"{overlay}/{path}", "w") as file:
            file.write(text)
        if path.startswith("kernels/"):
            if not self._compile_kernels(path, text, overlay):
                return False
        self.objects = []
        for source in self.build.sources_of(path):
            made = f"{self.folder}/{self.build.members[source][0].replace('/', '_')}.o"
            place = self._with_mutant(source, path, overlay)
            command = self.build.compile[source].replace(f"-c {source}", f"-c {place}")
            command = re.sub(r" -o \S+", f" -o {made}", command)
            command = re.sub(r" -M[DTF]\b( \S+\.o(\.d)?)?", "", command)
            command = command.replace(" -I", f" -I{overlay}/host -I{overlay}/cli -I{overlay}/made -I{overlay} -I", 1)
            code, said = self.run(command + " -Wno-error", COMPILE_SECONDS)
            if code != 0:
                return False
            self.objects.append(made)
        return bool(self.objects)

    def _with_mutant(self, source, path, overlay):
        """The source to compile, with the mutant in its place."""
        original = f"{self.build.project}/{path}"
        if source == original:
            return f"{overlay}/{path}"
        if path not in self.build.members[source]:
            return source
        made = f"{overlay}/{os.path.basename(source)}"
        with open(made, "w") as file:
            file.write(open(source).read().replace(f'"{original}"', f'"{overlay}/{path}"'))
        return made

    def _compile_kernels(self, path, text, overlay):
        kernels = f"{self.build.project}/kernels"
        files = [path] if path.endswith(".cl") else [
            os.path.relpath(f, self.build.project) for f in sorted(glob.glob(f"{kernels}/*/*.cl"))]
        shutil.copytree(kernels, f"{overlay}/check")
        shutil.copy(f"{overlay}/{path}", f"{overlay}/check/{path.removeprefix('kernels/')}")
        for file in files:
            code, _ = self.run(f"clang -I{overlay}/check -x cl -cl-std=CL1.2 -fsyntax-only -Xclang "
                               f"-finclude-default-header {overlay}/check/{file.removeprefix('kernels/')}",
                               COMPILE_SECONDS)
            if code != 0:
                return False
        made = open(f"{self.build.folder}/kernels/kernel_files.h").read()
        original = open(f"{self.build.project}/{path}").read()
        assert made.count(f'R"CLC({original})CLC"') == 1, path
        os.makedirs(f"{overlay}/made/kernels")
        with open(f"{overlay}/made/kernels/kernel_files.h", "w") as file:
            file.write(made.replace(f'R"CLC({original})CLC"', f'R"CLC({text})CLC"'))
        return True

    def link(self, program):
        made = f"{self.folder}/bin/{program}"
        # First: of what is inline the linker takes the first that it meets.
        command = re.sub(r" -o bin/\S+", f" -o {made}", self.build.link[program])
        has_cli = "libdefray_cli" in command
        objects = [o for o in self.objects if has_cli or not os.path.basename(o).startswith("cli_")]
        command = re.sub(r"(\S*/clang\+\+) ", r"\1 " + " ".join(objects) + " ", command, count=1)
        code, said = self.run(command, COMPILE_SECONDS)
        if code != 0:
            raise RuntimeError(f"{program} does not link:\n{said}")
        return made

    def environment(self, is_kernel):
        cache = f"{self.folder}/{'mutant' if is_kernel else 'kernel'}-cache"
        if is_kernel:
            shutil.rmtree(cache, ignore_errors=True)
        scratch = f"{self.folder}/scratch"
        shutil.rmtree(scratch, ignore_errors=True)
        for folder in (cache, scratch):
            os.makedirs(folder, exist_ok=True)
        return {"POCL_CACHE_DIR": cache, "TMPDIR": scratch, "RC_PARAMS": "seed=1994",
                "DEFRAY_TEST_PROGRAM": f"{self.folder}/bin/defray"}


def first_failure(said):
    failed = re.search(r"\[  FAILED  \] ([\w/.]+)", said)
    return failed.group(1) if failed else said.strip().split("\n")[-1][:100]


def longest_quick(tests):
    """Seconds of the longest of the quick tests."""
    left, longest = QUICK * sum(test.seconds for test in tests), 0
    for seconds in sorted(test.seconds for test in tests):
        left -= seconds
        if left < 0:
            break
        longest = seconds
    return longest


def chosen_tests(near, far, tests, budget):
    """Groups of tests, one process each: quick ones and near ones first, no longer than the budget."""
    left, groups = budget * sum(test.seconds for test in tests), []
    longest = longest_quick(tests)
    for indices, quick in [(near, True), (near, False), (far - near, True), (far - near, False)]:
        chosen = {}
        for index in sorted(indices, key=lambda i: tests[i].seconds):
            if (tests[index].seconds <= longest) == quick and tests[index].seconds <= left:
                left -= tests[index].seconds
                chosen.setdefault((tests[index].program, tests[index].is_long), []).append(index)
        groups += sorted(chosen.items(), key=lambda group: sum(tests[i].seconds for i in group[1]))
    return groups


def try_mutant(worker, path, text, near, far, tests, kernels, budget=BUDGET):
    """"killed by …", "timed out in …", "survived N tests" or "does not compile"."""
    if not worker.compile(path, text):
        return "does not compile"
    environment = worker.environment(bool(kernels) or path.startswith("kernels/"))
    linked = {}

    def program(name):
        if name not in linked:
            linked[name] = worker.link(name)
        return linked[name]

    if kernels:
        wanted = " ".join(f"--kernel {kernel}" for kernel in kernels)
        code, said = worker.run(f"{program('defray')} validate -o {worker.folder}/scratch/v {wanted}", VALIDATE_SECONDS,
                                environment)
        if code != 0:
            return "timed out in validate" if code is None else "killed by validate"
    count = 0
    for (name, is_long), indices in chosen_tests(near, far, tests, budget):
        if name == "command_tests":
            program("defray")
        usual = sum(tests[i].seconds for i in indices)
        filters = ":".join(tests[i].name for i in indices)
        code, said = worker.run([program(name), f"--gtest_filter={filters}", "--gtest_fail_fast"],
                                HANGS[0] + HANGS[1] * usual,
                                {**environment, **({"DEFRAY_TEST_LONG": "1"} if is_long else {})})
        if code != 0:
            return f"timed out in {name}" if code is None else f"killed by {first_failure(said)}"
        count += len(indices)
    if path.startswith("host/validation/"):  # a blind check passes all kernels, and the faults put into them
        code, said = worker.run([program("faults_tests"), "--gtest_fail_fast"], FAULTS_SECONDS, environment)
        if code != 0:
            return "timed out in faults_tests" if code is None else f"killed by {first_failure(said)}"
    if kernels and shutil.which("oclgrind"):  # memory beyond a buffer may hold what does no harm
        code, said = worker.run(f"oclgrind {program('defray')} validate --quick -o {worker.folder}/scratch/o {wanted}",
                                OCLGRIND_SECONDS, environment)
        if code not in (0, None):
            return "killed by Oclgrind"
    return f"survived {count} tests"
