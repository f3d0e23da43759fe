#!/usr/bin/env bash
# The Windows installer's handling of files, tried under Wine around a stand-in payload: install, upgrade, remove, in a
# folder with a long non-Latin name. Needs makensis and wine. What it does not show: the packed program itself on Windows.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."

say() { printf 'windows-test: %s\n' "$*"; }
fail() { printf 'windows-test: %s\n' "$@" >&2; exit 1; }
command -v makensis >/dev/null || fail "makensis is missing: apt-get install nsis"
command -v wine >/dev/null || fail "wine is missing: apt-get install wine wine64"

work=$(mktemp -d "${TMPDIR:-/var/tmp}/windows-test.XXXXXX")
export LC_ALL=C.UTF-8 WINEPREFIX=$work/prefix WINEDEBUG=-all WINEARCH=win64 DISPLAY="" WINEDLLOVERRIDES="mscoree,mshtml="
trap 'wineserver -k 2>/dev/null || true; rm -rf "$work"' EXIT

# 64 bit, since 32-bit programs need more of Wine than Debian installs.
build() { python3 installer/package/windows/setup_program.py --stand-in --target amd64-unicode "$@" >/dev/null; }
build --version 0.0.9 --output "$work/old.exe"
build --output "$work/new.exe"
say "both installers built by $(makensis -VERSION)"
wineboot --init >/dev/null 2>&1 || fail "wine does not start"

# Without spaces: /D= takes them only unquoted, which wine's command line cannot say.
name='C:\Klinik_Süd\Пациенты_手_und_noch_ein_langer_Ordnername_dazu\Carpus'
folder="$WINEPREFIX/drive_c/Klinik_Süd/Пациенты_手_und_noch_ein_langer_Ordnername_dazu/Carpus"
data="$WINEPREFIX/drive_c/users/$(id -un)/AppData/Local/carpus"
mkdir -p "$data/sessions"
echo "a patient's" >"$data/sessions/one.h5"
value() { wine reg query "$1" /v "$2" 2>/dev/null | tr -d '\r' | sed -n "s/^ *$2 *REG_[A-Z]* *//p"; }
uninstall='HKCU\Software\Microsoft\Windows\CurrentVersion\Uninstall\Carpus'

wine "$work/old.exe" /S "/D=$name"
[ -f "$folder/Carpus-window.exe" ] || fail "nothing was installed"
[ "$(find "$folder" -name 'файл.txt' | wc -l)" = 1 ] || fail "a deep non-Latin file is missing"
[ "$(value "$uninstall" DisplayVersion)" = 0.0.9 ] || fail "not among the installed programs"
[ -f "$WINEPREFIX/drive_c/users/$(id -un)/AppData/Roaming/Microsoft/Windows/Start Menu/Programs/Carpus.lnk" ] || fail "no start menu"
wine reg query 'HKCU\Software\Classes\Carpus.Session\shell\open\command' >/dev/null 2>&1 || fail "no file type"
[ ! -e "$WINEPREFIX/drive_c/Program Files/Carpus" ] || fail "it wrote where only an administrator may"
say "0.0.9 installed without an administrator"

echo left >"$folder/parts/of the old version.dll"
echo own >"$folder/a person's own.txt"
wine "$work/new.exe" /S   # finds the folder of the older version by itself
[ "$(value "$uninstall" DisplayVersion)" != 0.0.9 ] || fail "the version stayed"
[ ! -e "$folder/parts/of the old version.dll" ] || fail "a file of the old version stayed"
[ -f "$folder/Carpus-window.exe" ] || fail "the program went away"
say "upgraded in place to $(value "$uninstall" DisplayVersion)"

wine "$folder/uninstall.exe" /S   # goes on as a copy of itself, which ends a little later
wineserver --wait
[ "$(ls "$folder")" = "a person's own.txt" ] || fail "left behind: $(ls "$folder")"
! wine reg query "$uninstall" >/dev/null 2>&1 || fail "still among the installed programs"
! wine reg query 'HKCU\Software\Classes\Carpus.Session' >/dev/null 2>&1 || fail "the file type stayed"
[ ! -e "$WINEPREFIX/drive_c/users/$(id -un)/AppData/Roaming/Microsoft/Windows/Start Menu/Programs/Carpus.lnk" ] || fail "the start menu's entry stayed"
[ "$(cat "$data/sessions/one.h5")" = "a patient's" ] || fail "a patient's file was touched"
say "removed; a patient's session and a person's own file stayed: passed"
