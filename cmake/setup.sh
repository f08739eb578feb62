# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=sh
# Shared by ./lampyris and ./test: installs what is missing and builds. To be sourced by sh, with
# `root` set to the checkout.

say() { printf '%s\n' "$*" >&2; }
die() {
  say "$*"
  exit 3
}

# Files that list packages; callers may add to it.
package_lists=$root/packages.txt

# Packages of the lists that are not installed.
missing_packages() {
  command -v dpkg-query >/dev/null || return 0
  # shellcheck disable=SC2086
  for package in $(sed 's/#.*//' $package_lists); do
    dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed ||
      printf '%s ' "$package"
  done
}

install_packages() {
  missing=$(missing_packages)
  [ -n "$missing" ] || return 0
  as_root=
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null ||
      die "These packages are missing and only root can install them: apt-get install $missing"
    as_root=sudo
  fi
  say "Installing $missing"
  log=$(mktemp)
  # The package lists are fetched only where those at hand do not do.
  # shellcheck disable=SC2086
  { $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends \
      $missing ||
    { $as_root env DEBIAN_FRONTEND=noninteractive apt-get update &&
      $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends \
        $missing; }; } >"$log" 2>&1 </dev/null || {
    tail -n 20 "$log" >&2
    rm -f "$log"
    die "Could not install: $missing"
  }
  rm -f "$log"
}

# run_logged LOG COMMAND…: shows ninja's progress on one line of a terminal; on failure the log's
# end.
run_logged() {
  log=$1
  shift
  status_file=$log.status
  { "$@" 2>&1 </dev/null; echo $? >"$status_file"; } | {
    if [ -t 2 ]; then
      while IFS= read -r line; do
        printf '%s\n' "$line"
        case $line in \[*) printf '\r%.78s\033[K' "$line" >&2 ;; esac
      done >>"$log"
      printf '\r\033[K' >&2
    else
      cat >>"$log"
    fi
  }
  status=$(cat "$status_file")
  rm -f "$status_file"
  [ "$status" -eq 0 ] && return 0
  tail -n 60 "$log" >&2
  return "$status"
}

# build PRESET TARGET…
build() {
  preset=$1
  shift
  install_packages
  directory=$root/build/$preset
  mkdir -p "$directory"
  # One build at a time: a second caller waits, and then finds everything built.
  exec 9>"$directory/.lock"
  flock 9
  log=$directory/build.log
  : >"$log"
  # Its time is when the build began: what changes meanwhile is built the next time.
  touch "$directory/.stamp.new"
  say "Building ($preset); log: $log"
  (
    cd "$root" || exit 3
    [ -f "$directory/build.ninja" ] || run_logged "$log" cmake --preset "$preset" || exit $?
    run_logged "$log" ninja -C "$directory" "$@"
  ) || die "The build failed; the whole log is $log"
  mv "$directory/.stamp.new" "$directory/.stamp"
  exec 9>&-
}
