#!/usr/bin/env bash
# Checks that all our files are laid out as .clang-format says: format.sh PROJECT [-i]: or does it.
set -euo pipefail
cd "$1"
how=${2:---dry-run --Werror}
git ls-files '*.cpp' '*.h' '*.c' '*.cl' '*.clh' '*.def' | xargs -r clang-format $how
