#!/usr/bin/env bash
# Installs what is missing, builds scantet and runs all of its tests. Works from any folder and without a terminal.
#   scripts/test.sh [ctest option...]     e.g. scripts/test.sh -L unit
# shellcheck source-path=SCRIPTDIR
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

scripts/install_deps.sh
configure -DSCANTET_BUILD_TESTS=ON -DSCANTET_WARNINGS_AS_ERRORS=ON
build --target all
exec ctest --preset release -j2 --output-on-failure "$@" </dev/null
