#!/bin/sh
# The tests render on Mesa's software Vulkan driver, and drive the window under a display without a screen. What is missing
# is installed; where that is not possible, this fails and says what to install. TETRALUX_GPU=none does without both,
# hardware without the driver.
set -eu
PATH="$PATH:/usr/sbin:/sbin"

[ "${TETRALUX_GPU:-}" != none ] || exit 0
# Metal and Direct3D come with the system, and the window is driven on Linux alone.
[ "$(uname -s)" = Linux ] || exit 0

has_library() { ldconfig -p 2>/dev/null | grep -q "$1"; }

has_driver() {
    [ "${TETRALUX_GPU:-}" != hardware ] || return 0
    has_library 'libvulkan\.so\.1' || return 1
    # A list of drivers set by hand replaces the folders.
    [ -z "${VK_DRIVER_FILES:-}${VK_ICD_FILENAMES:-}" ] || return 0
    for folder in /usr/share/vulkan/icd.d /etc/vulkan/icd.d /usr/local/share/vulkan/icd.d; do
        for file in "$folder"/lvp_icd*.json; do
            [ ! -e "$file" ] || return 0
        done
    done
    return 1
}

# The libraries are those that a window loads while it opens.
has_display() {
    command -v Xvfb >/dev/null 2>&1 && command -v xdotool >/dev/null 2>&1 || return 1
    for name in libX11 libXcursor libXi libXrandr libxkbcommon-x11; do
        has_library "$name\\.so" || return 1
    done
}

refuse() {
    {
        echo "error: a software Vulkan driver, or a display to test the window on, was not found, and $1."
        echo "Install them and run this again:"
        echo "  Debian, Ubuntu:  apt-get install $packages"
        echo "  Fedora:          dnf install mesa-vulkan-drivers vulkan-loader xorg-x11-server-Xvfb xdotool libXcursor libXi libXrandr libxkbcommon-x11"
        echo "  Arch:            pacman -S vulkan-swrast vulkan-icd-loader xorg-server-xvfb xdotool libxcursor libxi libxrandr libxkbcommon-x11"
        echo "or set TETRALUX_GPU=none to skip the tests that render on a graphics device."
    } >&2
    exit 1
}

packages="mesa-vulkan-drivers libvulkan1 xvfb xdotool libx11-6 libxcursor1 libxi6 libxrandr2 libxkbcommon-x11-0"
if has_driver && has_display; then exit 0; fi
command -v apt-get >/dev/null 2>&1 || refuse "this system has no apt-get to install it with"
as_root=
if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null 2>&1 || refuse "installing it needs root or sudo"
    # Asks for a password only where there is somebody to ask.
    if [ -t 0 ]; then as_root=sudo; else as_root='sudo -n'; fi
fi
echo "What the tests render on is missing: installing $packages with ${as_root:+$as_root }apt-get."
$as_root apt-get update -qq || echo "warning: the package lists could not be refreshed; trying with those at hand" >&2
# Word splitting is wanted: they are several.
# shellcheck disable=SC2086
$as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends $packages || refuse "apt-get could not install it"
has_driver || refuse "the driver is still missing after apt-get installed it"
has_display || refuse "the display is still missing after apt-get installed it"
