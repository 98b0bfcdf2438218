// Standard output and error, and text that is safe to print there. Writing throws nothing; errors are checked
// once at the end.
#pragma once

#include <string>
#include <string_view>

namespace edgewise::tools {

void print(std::string_view text);  // to stdout, or after print_to_stderr() to stderr

// For commands that write a file's data to stdout.
void print_to_stderr();

// Flushes stdout. False if any output since the start was lost, for example on a full disk. A pipe that its
// reader has closed counts as success.
bool stdout_is_whole();

// Prints "PROGRAM: MESSAGE" on stderr as one line; control characters become blanks.
void print_error(std::string_view message, std::string_view program = "edgewise");

// Prints a line on stderr, control characters as blanks, unless it was printed before: files may be read
// several times.
void print_note(std::string_view message);

// Whether a file descriptor is a terminal with cursor control; TERM=dumb or no TERM means none.
bool moves_cursor(int descriptor);

// The terminal's columns; 80 if the file descriptor is not a terminal.
int terminal_width(int descriptor = 1);

// For external text: file and scene names, and messages that quote them.
// Returns valid UTF-8 without control characters: replaces each control character and each invalid byte.
std::string printable(std::string_view text, char replacement = '?');

// The same, cut to a number of characters; a cut text ends in "..". Characters are never split.
std::string printable_within(std::string_view text, std::size_t columns);

}  // namespace edgewise::tools
