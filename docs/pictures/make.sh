#!/bin/sh
# Makes docs/pictures/method.jpg, the contact sheet: needs ImageMagick. Run from the project's root after
# `cargo build --release -p maze-app`.
set -eu
app=target/release/maze-app
[ -x "$app" ] || app=target/debug/maze-app
out=$(mktemp -d)
picture() {
    name=$1
    shift
    "$app" render assets/mazes/default.obj --size 640x360 --out "$out/$name.png" "$@"
}
picture 01 --quality low
picture 02 --quality high
picture 03 --quality high --tilt 12,-7 --ticks 25
picture 04 --quality high --tilt 3,-5 --ticks 40 --zoom 6
picture 05 --tilt 9,-7 --ticks 60 --zoom 2 --show gravity
picture 06 --tilt -6,5 --show planes
picture 07 --tilt 9,-7 --ticks 14 --zoom 3 --show search
picture 08 --tilt 9,-7 --ticks 60 --zoom 6 --engine published --show contact
picture 09 --tilt 9,-7 --ticks 60 --zoom 4 --show velocity
picture 10 --tilt 9,-7 --ticks 60 --zoom 3 --show clearance
montage "$out"/*.png -tile 2x5 -geometry +4+4 -background '#181410' -quality 64 docs/pictures/method.jpg
rm -r "$out"
