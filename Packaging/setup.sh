# Set-up shared by Packaging/run, Packaging/test and Packaging/deb, which source it.
#
# Everything here writes to stderr and prints nothing if there is nothing to do, so that the output
# of `Packaging/run ARGS...` is that of `petrous ARGS...`.

top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$top/build/release
program=$build/Application/Cli/petrous

say()
{
  printf '%s\n' "$*" >&2
}

fail()
{
  printf '%s: %s\n' "$(basename "$0")" "$*" >&2
  exit 1
}

# Prints the packages of dependencies.txt that are not installed, one per line: those that are
# needed, or, with `optional`, those with a question mark.
missing_packages()
{
  local wanted
  wanted=$(sed -e 's/#.*//' "$top/Packaging/dependencies.txt" |
    awk -v optional="${1:-}" 'NF && (/^\?/ ? 1 : 0) == (optional ? 1 : 0) { sub(/^\?/, "", $1); print $1 }')
  # dpkg-query fails for an unknown package, which is then missing.
  { dpkg-query -W -f='${db:Status-Status} ${Package}\n' $wanted 2>/dev/null || true; } |
    awk -v wanted="$wanted" '
      $1 == "installed" { here[$2] = 1 }
      END {
        count = split(wanted, names, /[ \n]+/)
        for (i = 1; i <= count; ++i)
          if (!(names[i] in here))
            print names[i]
      }'
}

# install_packages [optional]: with `optional` (missing_packages), whatever fails is only said.
install_packages()
{
  local missing as_root=() log=$top/build/apt.log
  command -v dpkg-query >/dev/null && command -v apt-get >/dev/null ||
    fail "this set-up needs Debian 12 with apt-get and dpkg; on another system install what Packaging/dependencies.txt names and build with 'cmake --preset release'"
  missing=$(missing_packages "${1:-}")
  [[ -n $missing ]] || return 0
  if [[ -n ${1:-} && $EUID -ne 0 ]] && ! sudo -n true 2>/dev/null; then
    say "Not installed, as that needs root:" $missing "(their tests are skipped)"
    return 0
  fi

  if [[ $EUID -ne 0 ]]; then
    command -v sudo >/dev/null ||
      fail "missing packages need root, and there is no sudo; as root: apt-get install --no-install-recommends" $missing
    as_root=(sudo)
    if ! sudo -n true 2>/dev/null; then
      [[ -t 0 ]] ||
        fail "missing packages need root, and sudo asks for a password without a terminal; as root: apt-get install --no-install-recommends" $missing
      sudo -v || fail "missing packages need root; sudo refused"
    fi
  fi

  say "Installing $(wc -w <<<"$missing") packages (log: $log) ..."
  # An unreachable source is not an error if the packages are available otherwise.
  "${as_root[@]}" apt-get update </dev/null >"$log" 2>&1 || true
  # Some packages are servers that tests start for themselves: none is started as a service. (Where
  # the system has a policy of its own, that decides.)
  local without_services='
    policy=/usr/sbin/policy-rc.d
    if [ ! -e $policy ] && printf "#!/bin/sh\nexit 101\n" >$policy && chmod 755 $policy; then
      trap "rm -f $policy" EXIT
      trap "exit 130" INT
      trap "exit 143" TERM
    fi
    "$@"'
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive sh -c "$without_services" sh \
    apt-get install -y --no-install-recommends -o DPkg::Lock::Timeout=300 $missing \
    </dev/null >>"$log" 2>&1 || {
    if [[ -n ${1:-} ]]; then
      say "apt-get could not install" $missing "(log: $log); their tests are skipped"
      return 0
    fi
    fail "apt-get could not install the missing packages (is there a network?): $(grep -m1 '^E: ' "$log" || tail -n1 "$log")"
  }
}

# configure [-DNAME=VALUE...]: runs cmake unless it has already run with these settings. Changed
# CMakeLists.txt files are handled by ninja. A new build folder compiles sources in batches.
configure()
{
  local stamp=$build/petrous-configured fresh=() log=$top/build/configure.log
  [[ -f $build/CMakeCache.txt ]] || fresh=(-DPETROUS_UNITY=ON)
  if [[ -f $build/CMakeCache.txt ]] &&
    ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$top" "$build/CMakeCache.txt"; then
    fresh=(--fresh) # the checkout was moved
  elif [[ -f $build/build.ninja && $stamp -nt $top/CMakePresets.json ]] &&
    [[ $# -eq 0 || $(<"$stamp") == "$*" ]]; then
    return 0
  fi
  say "Configuring $build ..."
  (cd "$top" && cmake --preset release ${fresh[@]+"${fresh[@]}"} "$@") </dev/null >"$log" 2>&1 || {
    cat "$log" >&2
    fail "configuring failed (log: $log)"
  }
  printf '%s' "$*" >"$stamp"
}

# compile [TARGET...]
compile()
{
  ninja -C "$build" "$@" </dev/null 2>&1 |
    sed -u -e '/^ninja: Entering directory/d' -e '/^ninja: no work to do/d' >&2 ||
    fail "the build failed"
}

# One set-up at a time per checkout; the lock is released by unlock or when the process ends.
lock()
{
  mkdir -p "$top/build" || fail "cannot write to $top/build"
  exec 9>"$top/build/lock"
  flock 9
}

unlock()
{
  exec 9>&-
}
