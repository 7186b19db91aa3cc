#!/bin/sh
# The tests render on Mesa's software Vulkan driver. Where it is missing, installs it; where that is not possible, fails
# and says what to install. TETRALUX_GPU=hardware or none does without.
set -eu
PATH="$PATH:/usr/sbin:/sbin"

case "${TETRALUX_GPU:-}" in
    hardware | none) exit 0 ;;
esac
# Metal and Direct3D come with the system.
[ "$(uname -s)" = Linux ] || exit 0

has_driver() {
    ldconfig -p 2>/dev/null | grep -q 'libvulkan\.so\.1' || return 1
    # A list of drivers set by hand replaces the folders.
    [ -z "${VK_DRIVER_FILES:-}${VK_ICD_FILENAMES:-}" ] || return 0
    for folder in /usr/share/vulkan/icd.d /etc/vulkan/icd.d /usr/local/share/vulkan/icd.d; do
        for file in "$folder"/lvp_icd*.json; do
            [ ! -e "$file" ] || return 0
        done
    done
    return 1
}

refuse() {
    {
        echo "error: no software Vulkan driver was found, and $1."
        echo "Install it and run this again:"
        echo "  Debian, Ubuntu:  apt-get install mesa-vulkan-drivers libvulkan1"
        echo "  Fedora:          dnf install mesa-vulkan-drivers vulkan-loader"
        echo "  Arch:            pacman -S vulkan-swrast vulkan-icd-loader"
        echo "or set TETRALUX_GPU=none to skip the tests that render on a graphics device."
    } >&2
    exit 1
}

has_driver && exit 0
command -v apt-get >/dev/null 2>&1 || refuse "this system has no apt-get to install it with"
as_root=
if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null 2>&1 || refuse "installing it needs root or sudo"
    # Asks for a password only where there is somebody to ask.
    if [ -t 0 ]; then as_root=sudo; else as_root='sudo -n'; fi
fi
echo "No software Vulkan driver was found: installing mesa-vulkan-drivers and libvulkan1 with ${as_root:+$as_root }apt-get."
$as_root apt-get update -qq || echo "warning: the package lists could not be refreshed; trying with those at hand" >&2
$as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends mesa-vulkan-drivers libvulkan1 || refuse "apt-get could not install it"
has_driver || refuse "it is still missing after apt-get installed it"
