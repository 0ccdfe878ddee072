# Sourced by ../play and ../check: installs the Debian packages that are missing, or prints the line that does.

# has_library NAME: whether the loader knows a shared library.
has_library() {
    local known
    known=$(ldconfig -p 2>/dev/null || /sbin/ldconfig -p 2>/dev/null || true)
    grep -q -F "$1 " <<<"$known"
}

# has_driver: whether there is a Vulkan loader and a driver for it.
has_driver() {
    has_library libvulkan.so.1 || return
    compgen -G "/usr/share/vulkan/icd.d/*.json" >/dev/null ||
        compgen -G "/etc/vulkan/icd.d/*.json" >/dev/null
}

# What drawing needs at run time; a window needs the X11 libraries too (Wayland's come with the desktop).
drawing_packages() { has_driver || echo mesa-vulkan-drivers libvulkan1; }
window_packages() {
    local library package
    while read -r library package; do
        has_library "$library" || echo "$package"
    done <<'END'
libX11.so.6 libx11-6
libX11-xcb.so.1 libx11-xcb1
libXcursor.so.1 libxcursor1
libXi.so.6 libxi6
libxkbcommon.so.0 libxkbcommon0
libxkbcommon-x11.so.0 libxkbcommon-x11-0
END
}

# install_packages PACKAGE...: through apt when root or with sudo; else says what to type and ends. Other systems have other
# names for them: there the missing ones are told and the work goes on.
install_packages() {
    (($#)) || return 0
    if ! command -v apt-get >/dev/null; then
        echo "possibly missing (Debian's names): $*" >&2
        return 0
    fi
    local line="apt-get update && apt-get install -y --no-install-recommends $*"
    if [[ $EUID -eq 0 ]]; then
        echo "installing: $*" >&2
        DEBIAN_FRONTEND=noninteractive bash -c "$line" >&2
    elif command -v sudo >/dev/null && { [[ -t 0 ]] || sudo -n true 2>/dev/null; }; then
        echo "installing with sudo: $*" >&2
        sudo DEBIAN_FRONTEND=noninteractive bash -c "$line" >&2
    else
        echo "missing: $*" >&2
        echo "type this, then start again:  sudo sh -c '$line'" >&2
        exit 2
    fi
}

need_cargo() {
    command -v cargo >/dev/null && return
    echo "cargo not found: install Rust from https://rustup.rs, then start again" >&2
    exit 2
}

# Mesa and Wayland libraries complain loudly when this is not set.
quiet_runtime_dir() {
    [[ -n ${XDG_RUNTIME_DIR:-} ]] && return
    our_runtime_dir=$(mktemp -d)
    export XDG_RUNTIME_DIR=$our_runtime_dir
    trap 'rm -rf "$our_runtime_dir"' EXIT
}
