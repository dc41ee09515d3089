// The only places where the program writes to its standard streams, the progress line apart.
#pragma once

#include <string>

namespace scantet {

/// To standard output.
void print(const std::string& text);

/// One line to standard error, "scantet: " in front.
void print_error_line(const std::string& text);

/// Says on standard error that the user cancelled; returns the exit status for that.
int print_cancelled();

/// Flushes standard output. Throws Error (output.stdout) if anything printed could not be written.
void finish_printing();

}  // namespace scantet
