#!/usr/bin/env bash
# Checks that the host's includes go downwards in host/README.md's list of rooms: includes.sh PROJECT
set -euo pipefail
cd "$1/host"
grep -rn --include='*.cpp' --include='*.h' '^#include "' . | awk '
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
    own = part[1]; sub("/.*", "", own)
    other = $0; sub(".*#include \"", "", other); sub("/.*", "", other)
    if (!(own in level)) { print part[1] ": room " own " is not in host/README.md"; bad = 1 }
    if (other in level && level[other] > level[own]) {
      print part[1] ":" part[2] ": " own " includes " other ", which lies above it"; bad = 1
    }
    seen++
  }
  END {
    if (rooms < 10 || seen < 500) { print "looked at " rooms " rooms, " seen " includes: too few"; bad = 1 }
    exit bad
  }' README.md -
