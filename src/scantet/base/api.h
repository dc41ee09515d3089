// What the shared library shows of itself. Everything else is hidden.
#pragma once

/// Stands before the name of the namespace in every public header (cmake/PublicHeaders.cmake): what is declared there
/// can be linked, and its types are the same in the library, in programs and in plugins.
#define SCANTET_API [[gnu::visibility("default")]]

/// The same in headers that are not public, for what scantet's own programs need. Nobody else may rely on it.
#define SCANTET_PROGRAM_API [[gnu::visibility("default")]]
