# Shared by the scripts: what is installed, what is built, which step runs. Sourced, not run.
# shellcheck shell=bash

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build
# A script that wants another build than the usual one sets these.
build_type=Release
build_flags=()

die() {
  echo "$(basename "$0"): $*" >&2
  exit 2
}

# step WHAT: announces a step with its number and the seconds since the start.
step_number=0
step() {
  step_number=$((step_number + 1))
  printf '[%d, %d s] %s\n' "$step_number" "$SECONDS" "$*"
}

# Of the lists in scripts/ that are named; packages.txt is what everything needs.
missing_packages() {
  local package status
  while read -r package; do
    status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
    [[ $status == installed ]] || echo "$package"
  done < <(cd "$root/scripts" && cat "$@")
}

# set_up install|list [LIST…]: brings in what is missing, of packages.txt and further lists, or only says how to.
set_up() {
  local -a lists=(packages.txt "${@:2}")
  if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    echo "No apt-get here. These Debian packages, or their like, must be installed:"
    echo "  $(cd "$root/scripts" && cat "${lists[@]}" | paste -sd' ')"
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
  "${as_root[@]}" apt-get update -qq || die "apt-get update failed"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends \
    "${missing[@]}" >/dev/null || die "apt-get could not install ${missing[*]}"
}

# build TARGETS…: below $build; only what changed is compiled.
build() {
  local -a configure=(-S "$root" -B "$build" "-DCMAKE_BUILD_TYPE=$build_type" "${build_flags[@]}")
  if [[ ! -f $build/CMakeCache.txt ]] && command -v ninja >/dev/null; then configure+=(-G Ninja); fi
  if [[ -n ${CI:-} ]]; then configure+=(-DEDGEWISE_WERROR=ON); fi
  cmake "${configure[@]}" >/dev/null || die "CMake could not configure the build; see above"
  cmake --build "$build" --parallel "$(nproc)" --target "$@" || die "the build failed; see above"
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
  die "no python3 has $*; on Debian: apt-get install python3-matplotlib"
}
