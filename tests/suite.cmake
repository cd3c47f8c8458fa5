# What `ctest` runs: few processes, each with many tests, as many of a program as keep all cores at
# work. Labels: "quick" runs without `run.sh --full`, "full" with it, "both" always.
set(here ${CMAKE_CURRENT_SOURCE_DIR})

# add_shards(NAME COUNT COST LABEL COMMAND...): COUNT processes that share a program's tests.
function(add_shards name count cost label)
  foreach(shard RANGE 1 ${count})
    math(EXPR index "${shard} - 1")
    set(test ${name})
    if(count GREATER 1)
      set(test ${name}_${shard})
    endif()
    add_test(NAME ${test} COMMAND ${ARGN})
    set_tests_properties(
      ${test}
      PROPERTIES LABELS "gtest;${label}" COST ${cost} TIMEOUT 900
                 ENVIRONMENT
                 "GTEST_TOTAL_SHARDS=${count};GTEST_SHARD_INDEX=${index};GTEST_OUTPUT=json:${CMAKE_BINARY_DIR}/results/${test}.json"
    )
    if("${label}" MATCHES "quick|both" OR ${name} MATCHES "^(sanitized|rest_of)")
      set(reached ${CMAKE_BINARY_DIR}/reached/${test})
      file(MAKE_DIRECTORY ${reached})
      set_property(TEST ${test} APPEND PROPERTY ENVIRONMENT "DEFRAY_REACHED=${reached}")
    endif()
  endforeach()
endfunction()

# add_check(NAME COST LABEL COMMAND...)
function(add_check name cost label)
  add_test(NAME ${name} COMMAND ${ARGN})
  set_tests_properties(${name} PROPERTIES LABELS "check;${label}" COST ${cost} TIMEOUT 900)
endfunction()

# Left to --full: what takes seconds and looks again at what other tests look at, at more of it or in
# another way (windows, browsers, cold caches, damaged files, more settings of what is set elsewhere,
# more frames for the same twins); and defray-perf, which is not even built without it.
set(left_to_full
    ShowWindow.* *ReportOpensInABrowser KernelCache.* PerfCommand.* ReportCommand.*
    TuneCommand.IsUsed* TuneCommand.OfTheBuiltIn* TuneCommand.ADamaged*
    ValidateCommand.FastArithmetics* ValidateCommand.OfFloats* ValidateCommand.ACaseRuns*
    MethodCommand.FastArithmetic* MethodCommand.EyeAnd* OptionsCommand.WorkGroups*
    TradeCommand.CommandsAre* TradeCommand.WithoutATruth* ChainCommand.Reference*
    ChainCommand.SameBits* ChannelsCommand.KernelsGive* Mistakes.* Sequences.* RenderFormats.*
    SplatCommand.APointCloudTooLarge* Files.APicture* Files.AGrey* Files.SkipExisting* Streams.Messages* Windows.Grow*
    Metadata.OptionsWin* Info.Suggests* BudgetCommand.AFile* BudgetCommand.Learns*
    SplatCommand.FramesOf* SplatCommand.AnEye* ErrorCommand.TheSummary* ErrorCommand.WrongUse*
    OutputCommand.*
    Session.EveryFile* ValidateDevice.* CocAccuracy.* RdbGather.GivesTheSameBits*
    Fill.*FarAway PatternSearch.LooksAt* RdbScatter.*Jitter ChainBands.*TheStages HighlightDisc.*
    ExtremeSums.* Scenes/ChainStages.* Chain.GivesEachStage* Nearest.KernelEquals*
    Sparse.IsTheSame* Gather.SameBits*
    Cutout.* Tuned.WorkGroups* Lights.Aiming* Aperture.BladesHave* Api.*)
list(JOIN left_to_full ":" left_to_full)
foreach(shards "command 3 50" "kernels 2 40" "host 1 30")
  separate_arguments(shards)
  list(GET shards 0 name)
  add_shards(${shards} quick bash -c "exec \"$0\" --gtest_filter=\"\${GTEST_FILTER:-*-$1}\""
             $<TARGET_FILE:${name}_tests> "${left_to_full}")
endforeach()
# One seed: `RC_PARAMS=seed=N` repeats what a failure prints; without it every run is new.
add_shards(properties 1 1 both properties_tests)
set_property(TEST properties APPEND PROPERTY ENVIRONMENT "RC_PARAMS=seed=1994")

# The commands of every README, and with --full those too that take minutes.
file(GLOB readmes CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/*/README.md)
foreach(readme ${readmes})
  cmake_path(GET readme PARENT_PATH folder)
  cmake_path(GET folder FILENAME folder)
  if(readme STREQUAL ${PROJECT_SOURCE_DIR}/README.md)
    set(folder project)
  endif()
  # Those that take a minute, and that of perf, which takes minutes with --full, not at the end
  # beside nothing.
  set(cost 20)
  if(folder STREQUAL perf)
    set(cost 105)
  elseif(folder STREQUAL project OR folder STREQUAL cli)
    set(cost 45)
  endif()
  set(label both)
  if(folder STREQUAL perf)  # its program is built for --full
    set(label full)
  endif()
  add_check(readme_${folder} ${cost} ${label} bash ${here}/readme_test.sh ${readme}
            $<TARGET_FILE:defray>)
endforeach()
# validate's rehearsal there finds what Mesa has compiled for these.
set_tests_properties(readme_perf PROPERTIES DEPENDS "rusticl;validate_all")
# The installed library, as a user's project finds and uses it.
add_check(library 45 both bash ${here}/library/library_test.sh ${PROJECT_BINARY_DIR}
          ${PROJECT_SOURCE_DIR} ${CMAKE_CXX_COMPILER})
add_check(demo 20 full bash ${here}/demo_test.sh ${PROJECT_BINARY_DIR})
add_check(build 1 both bash ${here}/build_test.sh)
add_check(format 1 both bash ${here}/format.sh ${PROJECT_SOURCE_DIR})
add_check(includes 1 both bash ${here}/includes.sh ${PROJECT_SOURCE_DIR})

# All faults, on PoCL alone: every fault is a program to compile. Its frames are too small for two
# threads, which only wake each other.
add_shards(faults 2 90 full faults_tests)
set_property(TEST faults_1 faults_2 APPEND PROPERTY ENVIRONMENT POCL_MAX_PTHREAD_COUNT=1)

# The same kernel tests on another OpenCL implementation; not long ones, nor those of whole pictures,
# which many kernels make, nor long comparisons with twins: validate makes them there; nor what the
# host decides between or within whole renders. In one process: each compiles `fill` for half a minute.
set(left_out "KernelChecks.BandsHave*:Memory.PassesOfTheRdb*:PatternSearch.LooksAt*:ValidateDevice.WorkGroupsAre*:Nearest.OnlyOnDemand:Session.PlanesStay*:*.SameBitsInBandsOfAnyHeight:*Picture*:Target.*:HighlightDisc*:Alpha*:Lamp*:Chain*:Repair.Is*:Repair.Thin*:Rdb.SameBitsForEveryMemory*")
set(left_out ${left_out}:RdbScatter.*Equal*:Nearest.*Equal*:Patterns.*Equal*:ExpectedError.*:Progress.*:ExtremeSums.MeansOfLight*:KernelChecks.CompareAll*:KernelChecks.ShowWhat*:Fill.BehindA*:RdbGather.*EndOfTheChain:Sparse.*BesideLamps*:Split.SharesAre*:Patterns.Differences*:Memory.Bands*)
add_shards(rusticl 1 105 full bash -c
           "env -u DEFRAY_TEST_LONG \"$0\" --gtest_filter=\"\${GTEST_FILTER:-*}-$1\"" $<TARGET_FILE:kernels_tests> "${left_out}")
set_property(TEST rusticl APPEND PROPERTY ENVIRONMENT "RUSTICL_ENABLE=llvmpipe"
             "DEFRAY_TEST_DEVICE=llvmpipe")

# Under Oclgrind those whose frames lead kernels where validate's random ones hardly do.
set(drawn "Extreme*:Fill.*:Mixed.*:Nearest.OnlyOnDemand:Repair.Sharp*:Soften.*:SplatProject.*:SplatResolve.*:Split.*:Stages.*-Split.SharesAreThoseASearchFinds:Fill.BehindAnyRectangle*:Fill.ALineGoes*:Fill.ALoneHigh*:Fill.StripesGo*")
add_check(oclgrind 60 full bash ${here}/oclgrind.sh $<TARGET_FILE:kernels_tests> "${drawn}")
add_check(oclgrind_races 10 full oclgrind $<TARGET_FILE:faults_tests> --gtest_filter=*Races*)
# Nothing run, or skipped, is "PASSED 0 tests" and exit code 0.
set_tests_properties(oclgrind_races PROPERTIES PASS_REGULAR_EXPRESSION "PASSED  . 2 tests")

# 'defray validate' keeps Oclgrind's findings itself. Reads of uninitialised memory are sought where
# Oclgrind 21.10 neither raises false alarms (on values that come through loops, or that another
# kernel has written: an even seed is one pass of gather_literal) nor breaks off; elsewhere validate's own two runs in buffers of different content show them.
set(validate $<TARGET_FILE:defray> validate -o ${CMAKE_BINARY_DIR}/validate)
add_check(oclgrind_validate 100 full oclgrind ${validate}_oclgrind)
add_check(oclgrind_uninitialised 20 full oclgrind ${validate}_uninitialised --kernel coc --kernel
          gather_tiles --kernel linear_psf --kernel mixed --kernel rdb_clear --kernel repair --kernel
          tiltshift)
add_check(oclgrind_uninitialised_gather 10 full oclgrind ${validate}_uninitialised_gather --kernel
          gather_literal --case 37x23,sparse,coc=5,cells=5,samples=7,seed=2)
set_tests_properties(oclgrind_uninitialised oclgrind_uninitialised_gather
                     PROPERTIES ENVIRONMENT OCLGRIND_UNINITIALIZED=1)
# On PoCL alone the README's does it with larger frames.
add_check(validate_all 60 full ${validate}_all --all --tiny)

# The host code under AddressSanitizer and UndefinedBehaviorSanitizer, built by run.sh; without them
# what costs too much there.
set(preset_run bash ${here}/preset_run.sh)
set(sanitized ${preset_run} asan ${CMAKE_BINARY_DIR}/asan/bin)
add_shards(sanitized_kernels 2 110 full ${sanitized}/kernels_tests)
add_shards(sanitized_host 1 110 full ${sanitized}/host_tests)
add_shards(sanitized_command 2 110 full ${sanitized}/command_tests)
add_shards(rest_of_kernels 2 120 full ${preset_run} rest $<TARGET_FILE:kernels_tests>)
add_shards(rest_of_host 1 120 full ${preset_run} rest $<TARGET_FILE:host_tests>)
add_shards(rest_of_command 1 120 full ${preset_run} rest $<TARGET_FILE:command_tests>)

# Three mutants: that they are still tried and found; a change of a file draws others, and the twentieth
# of a mutant's tests that is nearest keeps one that nothing finds from taking minutes. Three are few:
# where two of them are not found, more are tried before tests are said to be worse than they were.
# What each test reaches the sanitized ones noted, and the long ones.
add_check(mutants 100 full python3 ${here}/mutation/mutate.py --count 3 --most 12 --seed 7 --jobs 1
          --fresh --least 60 --budget 0.05)
set_tests_properties(
  mutants
  PROPERTIES DEPENDS
             "sanitized_kernels_1;sanitized_kernels_2;sanitized_host;sanitized_command_1;sanitized_command_2;rest_of_kernels_1;rest_of_kernels_2;rest_of_host;rest_of_command;properties"
)

# Five seconds of every fuzzer, built by run.sh, from the seeds in corpus/ and what the runs before
# have found. What it finds it leaves as crash-… in the build folder's fuzz/.
file(GLOB fuzzers CONFIGURE_DEPENDS RELATIVE ${here}/fuzz/corpus ${here}/fuzz/corpus/*)
foreach(name ${fuzzers})
  file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/fuzz/found/${name})
  add_check(fuzz_${name} 5 full ${CMAKE_BINARY_DIR}/asan/bin/fuzz_${name} -max_total_time=5
            -timeout=60 -malloc_limit_mb=256 ${CMAKE_BINARY_DIR}/fuzz/found/${name}
            ${here}/fuzz/corpus/${name})
  set_tests_properties(fuzz_${name} PROPERTIES WORKING_DIRECTORY ${CMAKE_BINARY_DIR}/fuzz)
endforeach()
