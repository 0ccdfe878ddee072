#!/usr/bin/env bash
# Makes docs/pictures/screens.jpg: every screen of the game at 1280x720 and at 640x480, one small picture each.
# Needs Xvfb, xdotool and ImageMagick:  docs/pictures/screens.sh   (after cargo build --release -p maze-app)
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
work=$(mktemp -d)
Xvfb :98 -screen 0 1400x900x24 -nolisten tcp -noreset >/dev/null 2>&1 &
server=$!
trap 'kill $server; rm -rf "$work"' EXIT
export DISPLAY=:98 XDG_RUNTIME_DIR=$work XDG_CONFIG_HOME=$work
unset WAYLAND_DISPLAY
sleep 1

keys() { for key in "$@"; do xdotool key "$key"; sleep 0.5; done; }
shot() { sleep "${2:-1}"; import -window "$window" "$work/$1.$size.png"; }
for size in 1280x720 640x480; do
    (cd "$work" && exec "${CARGO_TARGET_DIR:-$root/target}/release/maze-app" play --title --demo >"$work/log" 2>&1) &
    until window=$(xdotool search --onlyvisible --name '^Maze'); do sleep 0.2; done
    xdotool windowfocus "$window" windowsize "$window" "${size%x*}" "${size#*x}"
    sleep 2
    shot 01-title
    keys Down Return Right; shot 02-levels
    keys Escape Down Return; shot 03-random
    keys Escape Down Return; shot 04-daily
    keys Escape Down Return; shot 05-open
    keys Escape Down Return Return Return Return; shot 06-how
    keys Escape Down Return; shot 07-settings
    keys Right Return; shot 08-controls
    keys Right Return; shot 09-keys
    keys Escape; keys Up Up Up Up Up Up Return; shot 10-playing 2
    keys Escape; shot 11-paused
    keys Escape; shot 12-result 12
    keys Return h; shot 13-all-keys
    kill %2 2>/dev/null || kill "$!"
    sleep 1
done
montage "$work"/*.1280x720.png -tile 4x -geometry 480x270+3+3 -background '#1a1512' "$work/large.png"
montage "$work"/*.640x480.png -tile 4x -geometry 480x360+3+3 -background '#1a1512' "$work/small.png"
convert "$work/large.png" "$work/small.png" -append -quality 80 "$root/docs/pictures/screens.jpg"
[[ -z ${KEEP:-} ]] || cp "$work"/*.png "$KEEP"
