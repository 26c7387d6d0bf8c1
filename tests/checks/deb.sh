#!/usr/bin/env bash
# usage: deb.sh BUILD_DIR
# The Debian package has everything in it and depends on the libraries that it needs.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cpack --config "$1/CPackConfig.cmake" -G DEB -B "$work" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
package=$(ls "$work"/*.deb)
dpkg-deb -c "$package" >"$work/contents"
dpkg-deb -f "$package" Depends >"$work/depends"
cat "$work/contents" "$work/depends"

failed=0
needs() { grep -Eq "$2" "$work/$1" || { echo "the package's $1 lack $2"; failed=1; }; }
needs contents ' \./usr/bin/curveskel$'
needs contents ' \./usr/lib/.*/libcurveskel\.so'
needs contents ' \./usr/lib/.*/cmake/curveskel/curveskelConfig\.cmake$'
needs contents ' \./usr/include/curveskel/curveskel\.hpp$'
needs contents ' \./usr/include/curveskel/skeleton/extract\.hpp$'
needs contents ' \./usr/share/doc/curveskel/README\.md$'
needs contents ' \./usr/share/doc/curveskel/docs/formats\.md$'
needs depends 'libc6 '
needs depends 'libcholmod3 '
if grep -E '/tests?/|_test$|\.cpp$|curveskel-shapes' "$work/contents"; then
  echo "the package has files in it that belong to development"
  failed=1
fi
exit $failed
