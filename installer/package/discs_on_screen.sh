#!/usr/bin/env bash
# Where on the screen the discs of a picture are: blue spots of a screenshot that lie to each other as the clicks of the
# recording do. One line "X Y" a disc, in the order of the clicks; fails where not all are found.
# usage: discs_on_screen.sh SCREENSHOT.png CALIBRATION.json
set -euo pipefail

# "WRIST": [u, v], ... of the first block of clicks, one "u v" a line, in order.
clicks=$(tr -d '\n' <"$2" | grep -oE '"[A-Z]+[0-9]*": *\[ *[0-9.]+, *[0-9.]+ *\]' | sed -E 's/.*\[ *([0-9.]+), *([0-9.]+) *\]/\1 \2/')
# Saturated blue, then its connected parts that are about as wide as high: "x y".
spots=$(convert "$1" -colorspace HSL -separate \
    \( -clone 0 -threshold 52% \) \( -clone 0 -threshold 72% -negate \) \( -clone 1 -threshold 30% \) -delete 0-2 \
    -evaluate-sequence min -define connected-components:verbose=true -define connected-components:area-threshold=40 \
    -connected-components 8 null: | awk '/(gray|srgb)\((255|100%)|white/ {
        split($2, box, /[x+]/); if (box[1] < 90 && box[2] < 90 && box[1] < 1.8 * box[2] && box[2] < 1.8 * box[1]) { sub(",", " ", $3); print $3 }
    }')
awk -v clicks="$clicks" -v spots="$spots" 'BEGIN {
    n = split(clicks, c, "\n"); m = split(spots, s, "\n")
    for (i = 1; i <= n; i++) { split(c[i], p, " "); u[i] = p[1]; v[i] = p[2] }
    for (j = 1; j <= m; j++) { split(s[j], p, " "); x[j] = p[1]; y[j] = p[2] }
    # Two spots for the first and the last click give scale and place; all others must lie where these say.
    for (a = 1; a <= m; a++) for (b = 1; b <= m; b++) if (a != b) {
        far = sqrt((u[n] - u[1]) ^ 2 + (v[n] - v[1]) ^ 2); scale = sqrt((x[b] - x[a]) ^ 2 + (y[b] - y[a]) ^ 2) / far
        worst = 0
        for (i = 1; i <= n; i++) {
            px = x[a] + scale * (u[i] - u[1]); py = y[a] + scale * (v[i] - v[1]); least = 1e9
            for (j = 1; j <= m; j++) { d = sqrt((x[j] - px) ^ 2 + (y[j] - py) ^ 2); if (d < least) { least = d; near = j } }
            if (least > worst) worst = least
            found[i] = near
        }
        if (best == "" || worst < best * scale) { best = worst / scale; for (i = 1; i <= n; i++) kept[i] = found[i] }
    }
    if (n == 0 || best == "" || best > 5) { print "no discs on the screen: " m " blue spots, " n " clicks, off by " best " pixels of the camera" > "/dev/stderr"; exit 1 }
    for (i = 1; i <= n; i++) print int(x[kept[i]] + 0.5), int(y[kept[i]] + 0.5)
}'
