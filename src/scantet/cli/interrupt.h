// Ctrl-C: the first asks the computation to stop, the second ends the program at once.
#pragma once

namespace scantet {

/// Handles SIGINT and SIGTERM as above, and makes a file-size limit a write error instead of a fatal signal.
void install_signal_handlers();

/// True once SIGINT or SIGTERM has come.
bool interrupted();

}  // namespace scantet
