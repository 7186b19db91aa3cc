#!/bin/sh
# A session in the window by synthetic X input, under Xvfb: opens a mesh, draws a Gaussian on the histogram, turns the
# picture, saves the scene, undoes and redoes, compares 1D with 2D, exports; and holds the picture against the one that
# the command line makes of the saved scene. Needs Xvfb, xdotool and ImageMagick (Debian: xvfb xdotool imagemagick).
#
# sh scripts/view_session.sh [MESH [FIELD [FOLDER]]]: screenshots and files go to the folder [out/view].
set -eu
cd "$(dirname "$0")/.."
mesh=${1:-examples/data/fire_ug.vtu}
field=${2:-t}
folder=${3:-out/view}
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
rm -f "$folder/scene.toml" "$folder/exported.png" "$folder/rendered.png"
for tool in Xvfb xdotool import cmp; do
    command -v "$tool" >/dev/null || { echo "error: $tool is needed: apt-get install xvfb xdotool imagemagick" >&2; exit 1; }
done
cargo build --release --features viewer --bin tetralux
program=$PWD/target/release/tetralux

number=90
while [ -e "/tmp/.X11-unix/X$number" ]; do number=$((number + 1)); done
Xvfb ":$number" -screen 0 1280x800x24 >/dev/null 2>&1 &
server=$!
trap 'kill "$viewer" "$server" 2>/dev/null || true' EXIT
export DISPLAY=":$number"
unset WAYLAND_DISPLAY
sleep 1
"$program" view "$mesh" --field "$field" 2>"$folder/view.log" &
viewer=$!

shot() { import -window root "$folder/$1.png"; }
pause() { sleep "${1:-1}"; }
# From a place to another by small steps, as a hand goes.
drag() {
    xdotool mousemove "$1" "$2"; pause 0.2; xdotool mousedown 1; pause 0.2
    for share in 1 2 3 4 5; do
        xdotool mousemove $(($1 + ($3 - $1) * share / 5)) $(($2 + ($4 - $2) * share / 5)); pause 0.1
    done
    xdotool mouseup 1; pause 0.3
}
answer() { pause 0.5; xdotool key ctrl+a; pause 0.2; xdotool type --delay 15 "$1"; pause 0.3; xdotool key Return; pause 1; }
until_there() {
    tries=0
    while [ ! -s "$1" ]; do
        tries=$((tries + 1)); [ $tries -lt 120 ] || { echo "error: $1 was not written" >&2; shot failed; exit 1; }
        pause 0.5
    done
}

pause 8
shot open
xdotool mousemove 1100 250; pause 0.3
xdotool key g; pause 0.5
drag 1100 230 1135 205
pause 3
shot drawn
drag 400 400 480 430
pause 3
xdotool key ctrl+s
answer "$folder/scene.toml"
until_there "$folder/scene.toml"
xdotool key ctrl+z; pause 2
shot undone
xdotool key ctrl+y; pause 2
xdotool key c; pause 5
shot compare
xdotool key c; pause 1; xdotool key c; pause 2
xdotool key ctrl+e
answer "$folder/exported.png"
until_there "$folder/exported.png"
pause 1
shot end
"$program" render "$mesh" --scene "$folder/scene.toml" --integral auto -o "$folder/rendered.png"
cmp "$folder/exported.png" "$folder/rendered.png"
echo "the exported picture is the one that the command line renders of the saved scene: $folder"
