# Sourced by tests/run.sh and samples/run.sh.
#   require_packages PACKAGE...    installs the Debian packages that are missing, and says which
require_packages() {
    if ! command -v dpkg-query > /dev/null; then
        echo "== not a Debian system; needed are what Debian calls: $*"
        return
    fi
    local missing=() package
    for package in "$@"; do
        if [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2> /dev/null)" != installed ]; then
            missing+=("$package")
        fi
    done
    if [ ${#missing[@]} -eq 0 ]; then
        return
    fi

    local as_root=()
    if [ "$(id -u)" -ne 0 ]; then
        if ! command -v sudo > /dev/null; then
            echo "run.sh: missing packages: ${missing[*]}; install them as root, or install sudo" >&2
            exit 1
        fi
        as_root=(sudo)
    fi
    echo "== installing ${missing[*]}"
    local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y)
    # Package lists may be absent or old, then the first attempt fails.
    if ! "${apt[@]}" install --no-install-recommends "${missing[@]}" < /dev/null > /dev/null 2>&1; then
        "${apt[@]}" update < /dev/null
        "${apt[@]}" install --no-install-recommends "${missing[@]}" < /dev/null
    fi
}
