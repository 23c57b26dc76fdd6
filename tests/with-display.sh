#!/bin/sh
# Runs a program of the window on a virtual screen (Xvfb) with a window manager (openbox), which gives it the
# keyboard; exits with 77 if these are missing, which ctest counts as skipped. SCREEN: its size, 1280x800; GDK_SCALE=2
# doubles its pixel density.
if command -v xvfb-run >/dev/null && command -v xauth >/dev/null && command -v openbox >/dev/null; then
  exec env NO_AT_BRIDGE=1 GTK_A11Y=none GDK_BACKEND=x11 xvfb-run -a -s "-screen 0 ${SCREEN:-1280x800}x24" \
    sh -c 'openbox >/dev/null 2>&1 & exec "$@"' sh "$@"
fi
if [ -n "$DISPLAY" ]; then exec "$@"; fi
echo "skipped: no screen: neither xvfb-run (Debian: xvfb, xauth, openbox) nor DISPLAY is there"
exit 77
