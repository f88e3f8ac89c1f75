#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Writes a page for every declaration of the public headers (docs/headers.md) into a folder, build/api unless given:
#
#   tools/api_pages.sh [--if-installed] [FOLDER]
#
# Installs Doxygen if it is missing; with --if-installed it does not, and ends with 77 where Doxygen is missing. Ends with an
# error that names the declarations without a description, if there are any.
set -eu
cd "$(dirname "$0")/.."
if [ "${1:-}" = --if-installed ]; then
  shift
  command -v doxygen >/dev/null || { echo "doxygen is not installed: the pages are not made"; exit 77; }
else
  tools/install_packages.sh api-pages
fi
folder=${1:-build/api}
mkdir -p "$folder"
rm -rf "$folder/headers"
python3 tools/public_headers.py --pages "$folder/headers"
doxygen - <<END
PROJECT_NAME          = Latsch
PROJECT_NUMBER        = $(sed -n 's/^project(latsch VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
PROJECT_BRIEF         = "Headers for programs built on Latsch"
INPUT                 = docs/headers.md $folder/headers
FILE_PATTERNS         = *.h *.md
RECURSIVE             = YES
USE_MDFILE_AS_MAINPAGE = docs/headers.md
OUTPUT_DIRECTORY      = $folder
STRIP_FROM_PATH       = $folder/headers
GENERATE_LATEX        = NO
HAVE_DOT              = NO
QUIET                 = YES
WARN_AS_ERROR         = FAIL_ON_WARNINGS
JAVADOC_AUTOBRIEF     = YES
BUILTIN_STL_SUPPORT   = YES
AUTOLINK_SUPPORT      = NO
SORT_MEMBER_DOCS      = NO
VERBATIM_HEADERS      = NO
HTML_TIMESTAMP        = NO
END
echo "$folder/html/index.html"
