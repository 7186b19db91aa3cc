#!/bin/sh
# A session in the window by synthetic X input, under Xvfb: opens a mesh, draws a Gaussian on the histogram, turns the
# picture, saves the scene, undoes and redoes, compares 1D with 2D, exports; and holds the picture against the one that
# the command line makes of the saved scene. Needs Xvfb and xdotool (Debian: xvfb xdotool); with ImageMagick's
# import it leaves screenshots, too.
#
# sh scripts/view_session.sh [MESH [FIELD [FOLDER [WIDTHxHEIGHT]]]]: files go to the folder [out/view]. TETRALUX names the
# program; without it a release build is made.
set -eu
cd "$(dirname "$0")/.."
mesh=${1:-examples/data/fire_ug.vtu}
field=${2:-t}
folder=${3:-out/view}
size=${4:-1280x800}
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
rm -f "$folder"/scene.toml "$folder"/exported.png "$folder"/rendered.png "$folder"/display
for tool in Xvfb xdotool; do
    command -v "$tool" >/dev/null || { echo "error: $tool is needed: apt-get install xvfb xdotool" >&2; exit 1; }
done
if [ -z "${TETRALUX:-}" ]; then
    cargo build --release --features viewer --bin tetralux
    TETRALUX=$PWD/target/release/tetralux
fi

viewer=
Xvfb -displayfd 3 -screen 0 "${size}x24" 3>"$folder/display" >/dev/null 2>&1 &
server=$!
trap 'kill $viewer $server 2>/dev/null || true' EXIT

pause() { sleep "${1:-0.5}"; }
give_up() { echo "error: $1" >&2; shot failed; sed 's/^/tetralux: /' "$folder/view.log" >&2; exit 1; }
# Two minutes at most.
until_so() {
    what=$1
    shift
    tries=0
    until "$@" >/dev/null 2>&1; do
        tries=$((tries + 1))
        [ $tries -lt 240 ] || give_up "$what"
        pause
    done
}
shot() {
    if command -v import >/dev/null; then import -window root "$folder/$1.png"; fi
}
# From a place to another by small steps, as a hand goes.
drag() {
    xdotool mousemove "$1" "$2"; pause 0.4; xdotool mousedown 1; pause 0.4
    for share in 1 2 3 4 5; do
        xdotool mousemove $(($1 + ($3 - $1) * share / 5)) $(($2 + ($4 - $2) * share / 5)); pause 0.2
    done
    xdotool mouseup 1; pause
}
answer() { pause 1; xdotool key ctrl+a; pause; xdotool type --delay 30 "$1"; pause; xdotool key Return; }
count() { grep -c "shape = " "$1"; }

until_so "there is no X server" test -s "$folder/display"
DISPLAY=":$(cat "$folder/display")"
export DISPLAY
unset WAYLAND_DISPLAY
"$TETRALUX" view "$mesh" --field "$field" 2>"$folder/view.log" &
viewer=$!
# The title names what is open.
until_so "the window does not show the mesh" xdotool search --name "$(basename "$mesh")"
# There is no window manager that would place it and give it the keyboard.
xdotool search --name tetralux windowsize "${size%x*}" "${size#*x}" windowmove 0 0 windowfocus
pause 3
shot open

# Within the plot, in the panel at the right.
width=${size%x*}
x=$((width - 180))
xdotool mousemove $x 250; pause
xdotool key ctrl+s
answer "$folder/before.toml"
until_so "the first scene was not saved" test -s "$folder/before.toml"
xdotool mousemove $x 250; pause
xdotool key g; pause
drag $x 230 $((x + 35)) 205
pause 2
shot drawn
drag 400 400 480 430
pause 2
xdotool key ctrl+s
answer "$folder/scene.toml"
until_so "the scene was not saved" test -s "$folder/scene.toml"
[ "$(count "$folder/scene.toml")" -eq $(($(count "$folder/before.toml") + 1)) ] || give_up "no widget was drawn"
xdotool mousemove 400 400; pause
xdotool key ctrl+z; pause 2
shot undone
xdotool key ctrl+s
answer "$folder/undone.toml"
until_so "the undone scene was not saved" test -s "$folder/undone.toml"
[ "$(count "$folder/undone.toml")" -eq "$(count "$folder/before.toml")" ] || give_up "nothing was undone"
xdotool mousemove 400 400; pause
xdotool key ctrl+y; pause 2
xdotool key c; pause 4
shot compare
xdotool key c; pause; xdotool key c; pause 2
xdotool key ctrl+e
answer "$folder/exported.png"
until_so "the picture was not exported" test -s "$folder/exported.png"
pause
shot end
"$TETRALUX" render "$mesh" --scene "$folder/scene.toml" --integral auto -o "$folder/rendered.png"
cmp "$folder/exported.png" "$folder/rendered.png" || give_up "the exported picture is not the rendered one"
echo "the exported picture is the one that the command line renders of the saved scene: $folder"
