#!/usr/bin/env bash
# usage: deb.sh BUILD_DIR
# The Debian packages have everything in them and depend on the libraries that they need; the one
# without the window depends on nothing that only a window needs.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cpack --config "$1/CPackConfig.cmake" -G DEB -B "$work" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }

failed=0
open_package() {
  package=$1
  dpkg-deb -c "$work/${package}"_*.deb >"$work/contents"
  dpkg-deb -f "$work/${package}"_*.deb Depends >"$work/depends"
  cat "$work/contents" "$work/depends"
}
needs() { grep -Eq "$2" "$work/$1" || { echo "the $1 of $package lack $2"; failed=1; }; }
lacks() { if grep -E "$2" "$work/$1"; then echo "the $1 of $package have $2"; failed=1; fi; }

open_package curveskel
needs contents ' \./usr/bin/curveskel$'
needs contents ' \./usr/share/man/man1/curveskel\.1$'
needs contents ' \./usr/lib/.*/libcurveskel\.so'
needs contents ' \./usr/lib/.*/cmake/curveskel/curveskelConfig\.cmake$'
needs contents ' \./usr/include/curveskel\.hpp$'
needs contents ' \./usr/include/curveskel/extract\.hpp$'
needs contents ' \./usr/share/doc/curveskel/README\.md$'
needs contents ' \./usr/share/doc/curveskel/docs/formats\.md$'
needs depends 'libc6 '
needs depends 'libspqr2'
lacks contents '/tests?/|_tests?$|\.cpp$|curveskel-shapes|curveskel-view'
lacks depends 'libglfw|libimgui|libgl1'

open_package curveskel-view
needs contents ' \./usr/bin/curveskel-view$'
needs contents ' \./usr/share/man/man1/curveskel-view\.1$'
needs depends 'curveskel \(= '
needs depends 'libglfw3 '
lacks contents ' \./usr/bin/curveskel$|libcurveskel'

if compgen -G "$work/python3-curveskel_*.deb" >/dev/null; then
  open_package python3-curveskel
  needs contents ' \./usr/lib/python3/dist-packages/curveskel/__init__\.py$'
  needs contents ' \./usr/lib/python3/dist-packages/curveskel/__init__\.pyi$'
  needs contents ' \./usr/lib/python3/dist-packages/curveskel/_core\..*\.so$'
  needs depends 'curveskel \(= '
  needs depends 'python3 \(<< 3\.12\)'
  needs depends 'python3-numpy'
  lacks contents 'libcurveskel|/bin/'
  # Unpacked, it works.
  root=$work/root
  for package in curveskel python3-curveskel; do dpkg-deb -x "$work/${package}"_*.deb "$root"; done
  libraries=$(dirname "$(find "$root/usr/lib" -name 'libcurveskel.so.*' | head -1)")
  LD_LIBRARY_PATH=$libraries PYTHONPATH=$root/usr/lib/python3/dist-packages /usr/bin/python3 -c \
    'import curveskel; print(curveskel.__version__, curveskel.__file__)' | grep "$root" \
    || { echo "python3-curveskel cannot be imported"; failed=1; }
fi
exit $failed
