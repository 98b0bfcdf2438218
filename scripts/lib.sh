# Shared by the scripts: packages, builds, and the announcement of steps. Sourced, not run.
# shellcheck shell=bash

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build
# A script may set these for a build of its own.
build_type=Release
build_flags=()

die() {
  echo "$(basename "$0"): $*" >&2
  exit 2
}

# unknown ARGUMENT: the usage error for an argument that is none of the script's options.
unknown() {
  die "unknown argument '$1'; --help lists all"
}

# step WHAT [SECONDS]: announces a step with its number, the seconds since the start, and how long it takes at most on two cores.
step_number=0
step() {
  step_number=$((step_number + 1)) step_start=$SECONDS
  printf '[%d, %d s] %s%s\n' "$step_number" "$SECONDS" "$1" "${2:+ (up to $(duration "$2"))}"
}

# duration SECONDS: for people.
duration() {
  if (($1 < 60)); then echo "$1 s"; else echo "$(($1 / 60)) min $(($1 % 60)) s"; fi
}

# listed_packages LIST…: the packages of these lists in scripts/packages.txt, one per line.
listed_packages() {
  local list
  for list in "$@"; do sed -n "s/^$list: //p" "$root/scripts/packages.txt" | tr ' ' '\n'; done
}

# missing_packages LIST…: those of the packages that are not installed.
missing_packages() {
  local package status
  while read -r package; do
    status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
    [[ $status == installed ]] || echo "$package"
  done < <(listed_packages "$@")
}

# set_up install|list LIST…: installs the missing packages of the lists, or only names them.
set_up() {
  local -a lists=("${@:2}")
  if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    echo "No apt-get here. These Debian packages, or their like, must be installed:"
    echo "  $(listed_packages "${lists[@]}" | paste -sd' ')"
    return
  fi
  local -a missing as_root=()
  mapfile -t missing < <(missing_packages "${lists[@]}")
  [[ ${#missing[@]} -gt 0 ]] || return 0
  [[ $EUID -eq 0 ]] || as_root=(sudo)
  if [[ $1 == list ]]; then
    echo "Missing packages: ${missing[*]}" >&2
    echo "Install them with: ${as_root[*]:+${as_root[*]} }apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 2
  fi
  [[ $EUID -eq 0 ]] || command -v sudo >/dev/null ||
    die "not root and no sudo; as root, run: apt-get install --no-install-recommends ${missing[*]}"
  echo "Installing: ${missing[*]}"
  local log updated
  log=$(mktemp)
  # An update may fail for a server that none of these packages come from, so its messages count only where a package
  # was not found.
  updated=$("${as_root[@]}" env LC_ALL=C apt-get update -qq 2>&1) || true
  if "${as_root[@]}" env LC_ALL=C DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends \
    "${missing[@]}" >"$log" 2>&1; then
    rm "$log"
    return
  fi
  {
    if grep -qE 'Unable to locate package|has no installation candidate' "$log"; then echo "$updated" >>"$log"; fi
    if grep -qiE 'resolv|connect|unreachable|timed out|failed to fetch|unable to fetch' "$log"; then
      echo "No network: apt-get could not reach a package server. Install these packages by hand, then run this again:"
    else
      echo "apt-get failed. Install these packages by hand, then run this again:"
    fi
    echo "  ${as_root[*]:+${as_root[*]} }apt-get install --no-install-recommends ${missing[*]}"
    echo "apt-get said:"
    cat "$log"
  } >&2
  rm "$log"
  exit 2
}

# unpack_swiftshader: SwiftShader from Chromium's package, which is not installed, since it needs half a desktop. Two
# copies, since a process has one pool of threads per copy. Without a package server, SwiftShader is left out.
unpack_swiftshader() {
  local folder=$root/build/swiftshader partial=$root/build/swiftshader.$$ file=vk_swiftshader_icd.json
  [[ ! -f $folder/2/$file ]] && command -v apt-get >/dev/null || return 0
  echo "Unpacking: SwiftShader from chromium-common"
  mkdir -p "$partial/1"
  # shellcheck disable=SC2016 # dpkg-deb's own variables
  if (
    cd "$partial" && { apt-get download -qq chromium-common || { apt-get update -qq && apt-get download -qq chromium-common; }; } &&
      dpkg-deb --fsys-tarfile chromium-common_*.deb |
      tar -x -C 1 --strip-components=4 ./usr/lib/chromium/libvk_swiftshader.so "./usr/lib/chromium/$file" &&
      dpkg-deb -W --showformat='${Package} ${Version}' chromium-common_*.deb >package && rm chromium-common_*.deb && cp -R 1 2
  ) 2>"$partial/log"; then
    rm "$partial/log"
    mv -T "$partial" "$folder"
  else
    echo "Left out: swiftshader: chromium-common could not be unpacked: $(tail -n 1 "$partial/log")" >&2
    rm -r "$partial"
  fi
}

# build TARGETS…: an incremental build in $build. A terminal gets the build's own progress; elsewhere only warnings and errors
# pass.
build() {
  local -a configure=(-S "$root" -B "$build" "-DCMAKE_BUILD_TYPE=$build_type" "${build_flags[@]}")
  if [[ ! -f $build/CMakeCache.txt ]] && command -v ninja >/dev/null; then configure+=(-G Ninja); fi
  if [[ -n ${CI:-} ]]; then configure+=(-DEDGEWISE_WERROR=ON); fi
  cmake "${configure[@]}" >/dev/null || die "CMake could not configure the build; see above"
  local start=$SECONDS
  local progress='^\[ *[0-9]+(%|/[0-9]+)\]|^(ninja: no work to do|(Consolidate compiler generated|Scanning) dependencies of target)'
  local -a compile=(cmake --build "$build" --parallel "$(nproc)" --target "$@")
  if [[ -t 1 && ${TERM:-dumb} != dumb ]]; then
    "${compile[@]}" || die "the build failed; see above"
  else
    "${compile[@]}" 2>&1 | { grep -vE --line-buffered "$progress" || true; } || die "the build failed; see above"
  fi
  echo "Built in $(duration $((SECONDS - start)))"
}

# python_with MODULE…: the first interpreter that has the modules. The python3 on the PATH may be one that Debian's
# packages don't reach.
python_with() {
  local python
  for python in python3 /usr/bin/python3; do
    if "$python" -c "import $(IFS=,; echo "$*")" 2>/dev/null; then
      echo "$python"
      return
    fi
  done
  die "no python3 has all of $*; packages.txt lists Debian's packages"
}
