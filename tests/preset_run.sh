#!/usr/bin/env bash
# Runs one instrumented test program: preset_run.sh asan|tsan|coverage PROGRAM [gtest arguments].
# preset_run.sh rest PROGRAM: without instruments what asan leaves out, and long tests.
set -euo pipefail
name=$1 program=$2
shift 2
tests=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
# Other runtimes that the loader opens leak as they are closed again, and then have no name.
export OCL_ICD_VENDORS=/etc/OpenCL/vendors/pocl.icd
# Without thread-local memory: LeakSanitizer's own tracer crashes there once all tests have passed
# (google/sanitizers issue 1353), in some programs each time.
export LSAN_OPTIONS=suppressions=$tests/presets/lsan.supp:print_suppressions=0:use_tls=0
# Leaks are sought in the library: asking each of 600 processes takes minutes.
case $program in *command_tests) export ASAN_OPTIONS=detect_leaks=0 ;; esac
export DEFRAY_TEST_PROGRAM=$(realpath "$(dirname "$program")")/defray
export UBSAN_OPTIONS=print_stacktrace=1
export TSAN_OPTIONS=suppressions=$tests/presets/tsan.supp:print_suppressions=0
# Left out what only costs time there, and runs without instruments: cold kernel caches, damaged
# files once more (host_tests reads them too), twins with jitter beside those without; and the real
# window, whose toolkit leaks; a limit of memory, which sanitizers go beyond; Blender; commands that compile kernels for each of many settings, or
# run in processes of their own, one after the other; and of commands those that take longest and
# reach no function that no other does. Long tests run where DEFRAY_TEST_LONG is set: for coverage.
unset DEFRAY_TEST_LONG
left_out=*SharedDamaged*:KernelCache.*:*PictureFloor*:HighlightDisc*
left_out+=:RdbScatter.*WithJitter:Cutout.*:LensSamples.AreMoreEven*:Fill.*FarAway:Repair.IsDone*:CocAccuracy.*:Lamp.*
left_out+=:Blender*:Mistakes.HalfFloatDepthOfASteepPlane:Streams.ClosedOnes*:Files.WhatKilled*:*FastArithmetic*:*WorkGroup*NoBit*:*ReportOpensInABrowser:TuneCommand.FindsKeeps*:ShowWindow.*:Rdb.SameBitsForEveryWorkGroup:Windows.AFrameTooLarge*:SplatCommand.APointCloudTooLarge*
left_out+=:Render.EveryOption*:Render.LensFromMetadata*:Render.ReportsWhat*:TradeCommand.ATruthTells*
left_out+=:Defaults.OfRender*:MethodCommand.MethodsAnd*:TunerAtWork.TriesAShape*
perf=PerfCommand.*:ReportCommand.*
if [ "$name" = rest ]; then
  longer=Arithmetic.*:$perf:Rdb.Huge*:ChainMemory.IsNoMore*:*EqualsTwin*:*EqualTwins*
  DEFRAY_TEST_LONG=1 exec "$program" --gtest_filter="${GTEST_FILTER:-$left_out:$longer}" "$@"
fi
case $name in
  asan) left_out+=:$perf ;;  # defray-perf is not built there
  tsan)
    left_out+=:*EveryDamagedFile*  # minutes, in OpenEXR's threads and not ours
    left_out+=:Parallel.AFork*
    export DEFRAY_TEST_EXEC=1 ;;   # it takes no forks of a process with threads
  coverage)
    left_out=*Huge*
    export DEFRAY_TEST_LONG=1 ;;
esac
exec "$program" --gtest_filter="${GTEST_FILTER:-*}-$left_out" "$@"
