# Sourced by what makes clean roots, as root: how this machine reaches the packages of Debian and Ubuntu, and how one
# enters a root. Wants roots, a folder of the caller's, and fail; gives mirror (empty: mmdebstrap knows the usual one),
# apt_config, a file with proxies and what is to be checked, new_root and inside.
mirror=$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' 'Origin: Debian' 2>/dev/null \
    | grep -v security | head -n 1 || true)
apt_config=$roots/apt.conf
{ apt-config dump Acquire 2>/dev/null || true; } \
    | grep -E '^Acquire::((http|https)(::[^ ]*)? "[^"]|Check-(Valid-Until|Date) )' >"$apt_config" || true

ubuntu_keyring=${UBUNTU_KEYRING:-/usr/share/keyrings/ubuntu-archive-keyring.gpg}
new_root() {  # SUITE ROOT LOG PACKAGES
    local suite=$1 root=$2 log=$3 sources=$mirror keys=()
    case "$suite" in
        bookworm | trixie) ;;
        *)
            [ -f "$ubuntu_keyring" ] || fail "$suite needs Ubuntu's keys: apt-get install ubuntu-keyring, or UBUNTU_KEYRING=FILE"
            keys=(--keyring="$ubuntu_keyring")
            sources=$(printf 'deb http://archive.ubuntu.com/ubuntu %s main universe\n' "$suite" "$suite-updates") ;;
    esac
    mmdebstrap "${keys[@]}" --variant=minbase --include="apt,$4" --aptopt="$apt_config" \
        "$suite" "$root" ${sources:+"$sources"} >"$log" 2>&1 || { tail -n 20 "$log"; return 1; }
    cp /etc/hosts "$root/etc/hosts"
    : >"$root/.folders"
}

# In mount and process spaces of their own, with an empty environment: nothing is left mounted or running, however this
# ends. Folders of this machine that are named in the root's /.folders are there too.
inside() {
    local root=$1; shift
    unshare --mount --pid --fork --kill-child bash -euo pipefail -c '
        root=$1; shift
        while read -r folder; do mkdir -p "$root$folder"; mount --rbind "$folder" "$root$folder"; done <"$root/.folders"
        mount -t proc proc "$root/proc"
        mount --rbind /dev "$root/dev"
        mount -t tmpfs tmpfs "$root/dev/shm"
        exec chroot "$root" /usr/bin/env -i "$@"
    ' inside "$root" "$@" </dev/null
}
