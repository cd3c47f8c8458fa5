#!/usr/bin/env bash
# Checks that the host's includes name their room, and go downwards in host/README.md's list of rooms:
# includes.sh PROJECT
set -euo pipefail
cd "$1/host"
grep -rnE --include='*.cpp' --include='*.h' --include='*.def' '^ *# *include *"' . | awk '
  # The innermost room of the list that a file lies in; its outermost folder where there is none.
  function room_of(path) {
    while (sub("/[^/]*$", "", path)) if (path in level || path !~ "/") return path
    return ""
  }
  # The rooms, first to last: rows of the first table.
  NR == FNR {
    if (match($0, /^\| \[?`[a-z/]+`/)) {
      room = substr($0, RSTART, RLENGTH)
      gsub(/[^a-z\/]/, "", room)
      level[room == "include/defray" ? "defray" : room] = ++rooms
    }
    next
  }
  {
    split($0, part, ":")
    sub("^\\./(include/)?", "", part[1])
    own = room_of(part[1])
    other = $0; sub(".*include *\"", "", other); sub("\".*", "", other)
    wrong = ""
    if (!(own in level)) wrong = "room " own " is not in host/README.md"
    else if (other !~ "/") wrong = "includes " other " without its room"
    else if (!((other = room_of(other)) in level) && other != "kernels") wrong = other " is no room of host/README.md"
    else if (level[other] > level[own]) wrong = own " includes " other ", which lies above it"
    if (wrong) { print part[1] ":" part[2] ": " wrong; bad = 1 }
    seen++
  }
  END {
    if (rooms < 10 || seen < 500) { print "looked at " rooms " rooms, " seen " includes: too few"; bad = 1 }
    exit bad
  }' README.md -
