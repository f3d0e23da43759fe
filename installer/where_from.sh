# Sourced by what makes clean roots: how this machine reaches Debian's packages. Wants roots, a folder of the caller's;
# gives mirror (empty: mmdebstrap knows the usual one) and apt_config, a file with proxies and what is to be checked.
mirror=$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' 'Origin: Debian' 2>/dev/null \
    | grep -v security | head -n 1 || true)
apt_config=$roots/apt.conf
{ apt-config dump Acquire 2>/dev/null || true; } \
    | grep -E '^Acquire::((http|https)(::[^ ]*)? "[^"]|Check-(Valid-Until|Date) )' >"$apt_config" || true
