#!/usr/bin/env bash
# The part of clean_root.sh that runs inside: a clinic's computer, from the first installation to the removal.
set -euo pipefail
say() { printf 'in the root: %s\n' "$*"; }
fail() { printf 'in the root: FAILED: %s\n' "$*"; exit 1; }
export DEBIAN_FRONTEND=noninteractive
out=/srv/out

# --- an older version, then this one over it; a clinician's account with data --------------------------------
dpkg --install /srv/older.deb >/dev/null
useradd --create-home --shell /bin/bash clinician
apt-get update -qq
apt-get install -y -qq --no-install-recommends /srv/carpus.deb >/dev/null
[ ! -e /opt/carpus/parts/of-the-old-version ] || fail "a file of the old version stayed"
say "installed $(dpkg-query --show --showformat='${Version}' carpus) over 0.0.9, $(du -sm /opt/carpus | cut -f1) MB in /opt/carpus"
! command -v python3 >/dev/null || fail "the package brought a Python of the system"
[ -n "$(ls /lib/udev/rules.d /usr/lib/udev/rules.d 2>/dev/null | grep -i openni)" ] || fail "no udev rules"

as_clinician() { runuser -u clinician -- env -i HOME=/home/clinician PATH=/usr/bin:/bin LANG=C.UTF-8 ${DISPLAY:+DISPLAY=$DISPLAY} "$@"; }
cd /home/clinician
as_clinician carpus --version
as_clinician carpus doctor | tee "$out/doctor.txt" || true

# --- the cameras: their libraries come by the second package; pip is never named -------------------------------------
doctor() { as_clinician carpus doctor --camera "$1" | tee "$out/doctor-$1.txt" || true; ! grep -w pip "$out/doctor-$1.txt" || fail "it says pip"; }
for camera in realsense orbbec; do
    doctor $camera; grep -q 'carpus-cameras-extra' "$out/doctor-$camera.txt" || fail "the second package is not named"
done
apt-get install -y -qq --no-install-recommends /srv/extra.deb >/dev/null
for camera in realsense orbbec; do
    doctor $camera; grep -qi "^ok  *$camera driver" "$out/doctor-$camera.txt" || fail "no driver for $camera"
    grep -q '^ok  *Camera rights' "$out/doctor-$camera.txt" || fail "no rights for $camera"
done
say "by the second package ($(dpkg-query --show --showformat='${Installed-Size}' carpus-cameras-extra) kB) RealSense and Orbbec are there"

# --- what the system knows of it --------------------------------------------------------------------------------
grep -q 'application/x-carpus-session=carpus.desktop' /usr/share/applications/mimeinfo.cache || fail "the desktop does not know the file type"
grep -q '^.*:application/x-carpus-session:\*.h5' /usr/share/mime/globs2 || fail "the file type has no ending"
[ -f /usr/share/man/man1/carpus.1 ] || [ -f /usr/share/man/man1/carpus.1.gz ] || say "the man page is left out here, as minimal systems do"

# --- a screen ------------------------------------------------------------------------------------------------------
Xvfb :7 -screen 0 1280x800x24 -nolisten tcp >/dev/null 2>&1 &
screen=$!
trap 'kill $screen 2>/dev/null || true' EXIT
export DISPLAY=:7
for _ in $(seq 50); do xdotool getdisplaygeometry >/dev/null 2>&1 && break; sleep 0.2; done

window() {  # starts the program; prints the seconds until its window is on the screen; its number in $program
    local start
    start=$(date +%s.%N)
    as_clinician carpus "$@" >>"$out/program.txt" 2>&1 &
    program=$!
    timeout 120 xdotool search --sync --onlyvisible --name '^Carpus$' >/dev/null || fail "no window"
    seconds=$(awk "BEGIN { printf \"%.1f\", $(date +%s.%N) - $start }")
}
shot() { import -window root "$out/$1.png"; }
close_window() { pkill -TERM -u clinician -o -x carpus || true; wait "$program" || fail "it ended with $?"; }

sync; echo 3 >/proc/sys/vm/drop_caches 2>/dev/null || say "the disk cache could not be emptied: not a cold start"
window demo; say "first window, cold: $seconds s (4 s were wanted; load $(cut -d' ' -f1 /proc/loadavg))"
sleep 3; shot first-window
xdotool search --onlyvisible --name '^Carpus$' windowfocus --sync
close_window
window demo; say "first window, warm: $seconds s (2 s were wanted; load $(cut -d' ' -f1 /proc/loadavg))"
close_window

# --- the practice session to its PDF, by keyboard and mouse ----------------------------------------------------------
later() {  # waits until a command holds: later SECONDS COMMAND...
    local end=$((SECONDS + $1)); shift
    until "$@" >/dev/null 2>&1; do [ $SECONDS -lt $end ] || return 1; sleep 1; done
}
kept() { find /home/clinician -name "$1" -path "$2" -size +0 | grep .; }
window demo
xdotool search --onlyvisible --name '^Carpus$' windowfocus --sync
sleep 2; xdotool type --delay 30 practice; sleep 1; xdotool key Return
later 180 kept 'truth*' '*/simulated/*' || { shot lost; fail "the practice patient was not drawn"; }
sleep 8; xdotool key space
found_discs() {  # twice at the same places: the picture is enlarged about the hand when it is taken
    local clicks
    shot markers
    while read -r clicks; do  # of all that were drawn, those of the recording that is shown
        /bin/bash /srv/discs_on_screen.sh "$out/markers.png" "$clicks" >"$out/discs-now.txt" || continue
        mv "$out/discs-now.txt" "$out/discs-$1.txt" && return 0
    done < <(kept calibration.json '*/simulated/*')
    return 1
}
still_discs() { found_discs before && sleep 2 && found_discs after && cmp "$out/discs-before.txt" "$out/discs-after.txt"; }
sleep 3; later 60 still_discs || fail "no discs to click (markers.png)"
while read -r x y; do xdotool mousemove --sync "$x" "$y" click 1; sleep 0.7; done <"$out/discs-after.txt"
sleep 5; shot clicked; xdotool key Return
sleep 5; xdotool key space; sleep 25; shot measuring
xdotool key space
later 60 kept '*.h5' '*/sessions/*' || { shot lost; fail "no session was stored"; }
session=$(kept '*.h5' '*/sessions/*' | head -n 1)
sleep 10; shot review; xdotool key ctrl+p
sleep 6; shot report; xdotool key ctrl+p
timeout 60 xdotool search --sync --onlyvisible --name '^Save report$' windowfocus --sync || fail "nothing asked where to save the report"
report=/home/clinician/by-hand.pdf
xdotool key ctrl+a; xdotool type --delay 10 "$report"; xdotool key Return
later 60 test -s "$report" || { shot lost; fail "the report was not saved"; }
sleep 2; close_window
[ "$(head -c 4 "$report")" = "%PDF" ] || fail "no report"
cp "$report" "$out/report.pdf"
say "by keyboard and mouse: the practice session is stored and its report saved, $(stat -c %s "$report") bytes"

# --- a double-click on a session ----------------------------------------------------------------------------------------
cp "$session" "/home/clinician/сессия of a stick.h5"; chown clinician "/home/clinician/сессия of a stick.h5"
window "/home/clinician/сессия of a stick.h5"
sleep 12; shot opened-by-file
close_window
say "a session file opens the window (opened-by-file.png)"

# --- an .oni file ----------------------------------------------------------------------------------------------------------
as_clinician carpus track /srv/oni/recording.oni --calibration /srv/oni/calibration.json --output /home/clinician/oni.h5
as_clinician carpus info /home/clinician/oni.h5 | tee "$out/oni.txt"
grep -qE '^Frames +(2[5-9]|30|31) ' "$out/oni.txt" || fail "the .oni was not played"
say "an .oni file was played and tracked"

# --- removed: nothing of the program is left, everything of the patients is ----------------------------------------------------
before=$(find /home/clinician -name '*.h5' | sort | xargs -d '\n' sha256sum | sha256sum)
apt-get purge -y -qq carpus carpus-cameras-extra >/dev/null
left=$(find / -xdev \( -path /proc -o -path /home -o -path /srv -o -path /var/log -o -path /var/cache -o -path /var/lib/apt \) -prune -o -iname '*carpus*' -print)
[ -z "$left" ] || fail "left behind: $left"
[ ! -e /opt/carpus ] || fail "/opt/carpus stayed"
! grep -q carpus /usr/share/applications/mimeinfo.cache /usr/share/mime/globs2 2>/dev/null || fail "the file type stayed"
[ "$(find /home/clinician -name '*.h5' | sort | xargs -d '\n' sha256sum | sha256sum)" = "$before" ] || fail "sessions changed"
say "removed without leftovers; $(find /home/clinician -name '*.h5' | wc -l) sessions stayed as they were"
