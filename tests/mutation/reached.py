"""Which tests reach which functions, as the tests themselves have noted (reached.cpp)."""
import bisect
import os
import re
import struct
import subprocess
from collections import defaultdict
from dataclasses import dataclass, field


@dataclass
class Test:
    program: str
    name: str
    seconds: float
    is_long: bool = False  # of those that --full alone runs
    functions: set = field(default_factory=set)  # (path, line where it begins)


class Reached:
    """What build/tests/reached holds, by path in the project."""

    def __init__(self, project, build):
        self.project = project
        self.tests = []
        for shard in sorted(os.listdir(f"{build}/reached")):
            binaries = f"{build}/asan/bin" if shard.startswith("sanitized") else f"{build}/bin"
            self._read(f"{build}/reached/{shard}", binaries, shard.startswith("rest_of"))
        self.by_path = defaultdict(set)       # path: indices of tests
        self.by_function = defaultdict(set)   # (path, line): indices of tests
        for index, test in enumerate(self.tests):
            for path, line in test.functions:
                self.by_path[path].add(index)
                self.by_function[path, line].add(index)
        self.beginnings = defaultdict(list)   # path: lines where functions begin
        for path, line in sorted(self.by_function):
            self.beginnings[path].append(line)

    def _read(self, folder, binaries, is_long):
        if not os.path.exists(f"{folder}/TESTS"):
            return
        places = {file[:-len(".places")]: self._places(f"{folder}/{file}", f"{binaries}/{file[:-len('.places')]}")
                  for file in os.listdir(folder) if file.endswith(".places")}
        for line in open(f"{folder}/TESTS"):
            program, name, milliseconds, *flags = line.split()
            test = Test(program, name, int(milliseconds) / 1000, is_long)
            for flag in flags:
                module, index = flag.split(":")
                place = places[module][int(index)] if module in places else None
                if place:
                    test.functions.add(place)
            self.tests.append(test)

    def _places(self, file, binary):
        data = open(file, "rb").read()
        addresses = "\n".join(hex(a) for a in struct.unpack(f"<{len(data) // 8}Q", data))
        answer = subprocess.run(["llvm-symbolizer", f"--obj={binary}", "--no-inlines", "--functions=none"],
                                input=addresses, capture_output=True, text=True, check=True).stdout
        found = []
        for place in answer.strip().split("\n\n"):
            match = re.match(re.escape(self.project) + r"/(.*):(\d+):\d+$", place.strip())
            found.append((match.group(1), int(match.group(2))) if match else None)
        return found

    def of_line(self, path, line):
        """Tests that reach the function around a line, and those that reach any of its file."""
        lines = self.beginnings[path]
        at = bisect.bisect_right(lines, line) - 1
        near = self.by_function[path, lines[at]] if at >= 0 else set()
        return near, self.by_path[path]
