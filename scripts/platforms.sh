# The platforms of `scripts/test --everywhere`. Sourced after lib.sh, not run.
# shellcheck shell=bash disable=SC2034,SC2154 # variables of lib.sh

platforms=$root/build/platforms

# unpack_sysroot FOLDER ARCHITECTURE: the libraries of packages.txt for another processor, unpacked, not installed. apt
# gets a state of its own for it, so the system's packages and lists do not change.
unpack_sysroot() {
  local packages package
  packages=$(listed_packages base | grep -- '-dev$')
  [[ $(cat "$1/packages" 2>/dev/null) != "$packages" ]] || return 0
  echo "Unpacking: packages for $2"
  rm -rf "$1"
  mkdir -p "$1"/apt/{lists,archives}/partial
  : >"$1/apt/status"
  local -a apt=(apt-get -qq -o "APT::Architecture=$2" -o "APT::Architectures=$2" -o APT::Sandbox::User=root
    -o "Dir::State=$1/apt" -o "Dir::State::status=$1/apt/status" -o "Dir::Cache=$1/apt")
  "${apt[@]}" update
  # shellcheck disable=SC2086 # one word per package
  "${apt[@]}" install -y --download-only --no-install-recommends $packages >"$1/apt/log"
  for package in "$1"/apt/archives/*.deb; do dpkg-deb -x "$package" "$1"; done
  rm -r "$1/apt"
  echo "$packages" >"$1/packages"
}

# noted COMMAND…: its last line, or that of the tests that passed, stands in the platform's result.
noted() {
  local status=0
  "$@" 2>&1 | tee "$found.log" || status=$?
  if ! grep -a '^\[  PASSED' "$found.log" >>"$found"; then tail -n 1 "$found.log" >>"$found"; fi
  return "$status"
}

# compare_hashes [OPTIONS…]: compares hashes on the platform that ${run[@]} starts. If one differs, draws that frame here
# and there, and prints the first pixels that differ, with their triangles, or the first bytes of its file.
compare_hashes() {
  noted "${run[@]}" "$build/edgewise_hashes" "$root/tests/hashes.json" "$@" && return
  local frame
  frame=$(sed -n '0,/: drawn by .*/s///p' "$found.log")
  [[ -z $frame ]] || diff <("$root/build/edgewise_hashes" "$root/tests/hashes.json" --dump "$frame") \
    <("${run[@]}" "$build/edgewise_hashes" "$root/tests/hashes.json" --dump "$frame") | head -n 20
  return 1
}

# facts [COMMAND…]: prints facts of small scenes, and a file of each kind. COMMAND… starts a program of $build.
facts() {
  local arguments scenes
  scenes=$(python3 -c 'import json, sys; print(*(s["name"] for s in json.load(sys.stdin)["scenes"] if s["kind"] == "small scenes"))' \
    <"$root/results/facts/accuracy.json")
  for arguments in "accuracy $scenes --json -" 'stability legs cycle vertex_w --quick --json -' 'needs cubes --json' \
    'portable cube --json' 'render cubes -o -' 'render cubes -o - --format ppm' 'render cubes --depth -' \
    'capture sphere -o -'; do # no picture with labels, which need Dear ImGui
    # shellcheck disable=SC2086 # words
    "$@" "$build/edgewise" $arguments
  done
}
facts_are_those_of_x86_64() {
  # Not one by one: as part of a condition, no failure ends a function.
  facts "$@" >"$found.facts" && cmp "$found.facts" "$platforms/x86_64.facts" &&
    echo "$(wc -c <"$found.facts") bytes of facts and files are those of x86-64"
}

# guest_tests [COMMAND…]: those of a program that uses the library; COMMAND… starts it. QEMU 7.2 cannot fork while threads run.
guest_tests() {
  build edgewise_guest_tests
  noted "$@" "$build/edgewise_guest_tests" --gtest_brief=1 ${1:+--gtest_filter=-ProcessFork.*:ProcessExit.*}
}

# A processor without FMA, for which the C library has other functions.
without_fma() {
  GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2 "$@"
}
on_x86_64() {
  local compiler kind
  build edgewise_program edgewise_hashes edgewise_library_tests edgewise_wrong_libm
  noted "$build/edgewise_hashes" "$root/tests/hashes.json"
  noted env "LD_PRELOAD=$build/libedgewise_wrong_libm.so" "$build/edgewise_hashes" "$root/tests/hashes.json"
  if grep 'cannot be preloaded' "$found.log"; then return 1; fi
  noted without_fma "$build/edgewise_hashes" "$root/tests/hashes.json"
  noted "$build/edgewise_library_tests" --gtest_brief=1
  guest_tests
  facts >"$platforms/x86_64.facts"
  for compiler in g++ clang++-14; do
    for kind in Release Debug; do
      local build=$platforms/x86_64-$compiler-$kind build_type=$kind
      local -a build_flags=(-DEDGEWISE_LABORATORY=OFF -DEDGEWISE_FILES=OFF "-DCMAKE_CXX_COMPILER=$compiler" -DEDGEWISE_WERROR=ON)
      build edgewise_hashes
      noted "$build/edgewise_hashes" "$root/tests/hashes.json" --frames 2000
      guest_tests
    done
  done
}
on_consumer() {
  build edgewise_bench # it is installed, too
  EDGEWISE_FULL=1 python3 "$root/tests/scripts/install_test.py" "$build" Installed.test_hashes_do_not_depend_on_the_users_flags >"$found"
}

# library_on PROCESSOR [OPTIONS…]: the hashes of the library alone, which needs no packages.
library_on() {
  local build=$platforms/$1-library
  local -a build_flags=("-DCMAKE_TOOLCHAIN_FILE=$root/tests/platforms/cross.cmake" "-DEDGEWISE_PROCESSOR=$1" -DEDGEWISE_WERROR=ON)
  local -a run=("qemu-$1" -L "/usr/$1-linux-gnu")
  build edgewise_hashes
  compare_hashes "${@:2}" || return
  guest_tests "${run[@]}"
  if [[ $1 == riscv64 ]]; then # elsewhere, program_on tests it, too
    build edgewise_contract_tests
    noted "${run[@]}" "$build/edgewise_contract_tests" --gtest_brief=1
  fi
}
# program_on PROCESSOR ARCHITECTURE: all that the laboratory's packages are needed for. Optimized less, to be built quickly.
program_on() {
  local build=$platforms/$1 build_type=None sysroot=$platforms/$1-packages
  local -a build_flags=("-DCMAKE_TOOLCHAIN_FILE=$root/tests/platforms/cross.cmake" "-DEDGEWISE_PROCESSOR=$1"
    "-DEDGEWISE_SYSROOT=$sysroot" -DEDGEWISE_WERROR=ON -DCMAKE_CXX_FLAGS=-O1
    -DCMAKE_DISABLE_FIND_PACKAGE_PkgConfig=ON) # it would find this machine's Dear ImGui
  local -a run=("qemu-$1" -L "$sysroot")
  unpack_sysroot "$sysroot" "$2"
  build edgewise_program edgewise_hashes edgewise_library_tests
  compare_hashes --frames 1000
  guest_tests "${run[@]}"
  # A death test starts its program again, which this processor cannot run.
  noted "${run[@]}" "$build/edgewise_library_tests" --gtest_brief=1 '--gtest_filter=-*DeathTest.*'
  noted facts_are_those_of_x86_64 "${run[@]}"
}
on_aarch64() {
  library_on aarch64
  program_on aarch64 arm64
}
on_s390x() {
  library_on s390x
  program_on s390x s390x
}
on_riscv64() { library_on riscv64; }
on_wasm32() { # kernels are scalar in both, since Highway's vectors there lack doubles; SIMD128 is the compiler's
  local vectors
  local -a run=(node --single-threaded --no-warnings --experimental-wasi-unstable-preview1 "$root/tests/platforms/wasm32/run.mjs")
  for vectors in '' -msimd128; do
    local build=$platforms/wasm32$vectors
    local -a build_flags=(--toolchain "$root/tests/platforms/wasm32/toolchain.cmake" "-DCMAKE_CXX_FLAGS=$vectors" -DEDGEWISE_WERROR=ON)
    build edgewise_hashes
    compare_hashes
  done
}

# on PLATFORM: tests it, and writes what was found.
on() {
  local found=$platforms/$1.found result=passed
  : >"$found"
  (set -e; "on_$1") >"$platforms/$1.log" 2>&1
  # shellcheck disable=SC2181 # where a subshell is a condition, a failed command does not end it
  (($? == 0)) || result=failed
  [[ -s $found ]] || echo "nothing found" >"$found"
  echo "$1: $result, $(duration $((SECONDS - step_start))) after the start of this step; see build/platforms/$1.log"
  [[ $result == passed ]] || tail -n 20 "$platforms/$1.log"
  sed "s/^/$1\t$result\t/" "$found" >"$platforms/$1.result"
}

# everywhere PLATFORM…: tests the first, with which others compare, then these, as many at once as there are cores. Writes
# platforms.tsv. Sets `status` to 1 if one fails.
everywhere() {
  local platform
  mkdir -p "$platforms"
  rm -f "$platforms"/*.{facts,result} # of an earlier run
  set +e
  trap 'trap - TERM; kill 0' INT # jobs in the background don't hear of Ctrl-C
  step "Testing on $1"
  on "$1"
  step "Testing on ${*:2}"
  for platform in "${@:2}"; do
    while (($(jobs -rp | wc -l) >= $(nproc))); do wait -n; done
    on "$platform" &
  done
  wait
  set -e
  for platform; do grep -qs $'\tpassed\t' "$platforms/$platform.result" || status=1; done
  cat "$platforms"/*.result >"$platforms/platforms.tsv.part"
  mv "$platforms/platforms.tsv"{.part,}
}
