# Sourced by run.sh and test.sh from the repository root: installs packages, configures and builds.
# Every step looks first whether there is anything to do, so that a second call costs next to nothing.

build_dir=build

fail() {
  echo "$*" >&2
  exit 1
}

# Runs a command as root.
as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    fail "Installing packages needs root: run this as root, or install sudo, or install by hand: ${missing[*]}"
  fi
}

# install_packages LIST...: the Debian packages of scripts/packages/LIST.txt, where they are missing.
install_packages() {
  local list package wanted=() missing=()
  for list in "$@"; do
    while read -r package; do
      case $package in '' | '#'*) ;; *) wanted+=("$package") ;; esac
    done <"scripts/packages/$list.txt"
  done
  command -v dpkg-query >/dev/null || fail "This installs its packages with apt and needs Debian 12. Elsewhere install what scripts/packages/ lists and build with cmake."
  local installed
  # dpkg-query fails when it does not know one of the names; what it prints is what counts.
  installed=$(dpkg-query --show --showformat '${db:Status-Status} ${Package}\n' "${wanted[@]}" 2>/dev/null || true)
  for package in "${wanted[@]}"; do
    grep -qx "installed $package" <<<"$installed" || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return
  echo "installing: ${missing[*]}" >&2
  as_root apt-get update -q >&2
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}" >&2
}

# install_build_packages: what building needs. Node.js and npm may also be there by other ways than Debian's packages.
install_build_packages() {
  install_packages build
  { command -v node && command -v npm; } >/dev/null || install_packages page
}

# install_page_tests: what drives the page in a browser, from the npm registry.
install_page_tests() {
  local installed=tests/web/node_modules/.package-lock.json
  [ "$installed" -nt tests/web/package-lock.json ] && return
  (cd tests/web && npm ci --ignore-scripts --no-audit --no-fund --loglevel=error) >&2
  touch "$installed"
}

# build_targets [TARGET...]: configures once and builds, everything when no target is named. Ninja configures again by itself
# when a CMake file changes.
build_targets() {
  [ -f "$build_dir/build.ninja" ] || cmake --preset release >&2
  if [ $# -eq 0 ]; then
    ninja -C "$build_dir" >&2
  else
    ninja -C "$build_dir" "$@" >&2
  fi
}
