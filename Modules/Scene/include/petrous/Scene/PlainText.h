#pragma once

#include <string>
#include <string_view>

namespace petrous::scene
{

/// Whether a UTF-8 text has characters that a terminal obeys, or that reorder others: C0 (but for
/// those of `allowed`), DEL and C1 controls; embeddings, overrides and isolates of the
/// bidirectional algorithm (U+202A to U+202E, U+2066 to U+2069).
bool hasControls(std::string_view text, std::string_view allowed = {}) noexcept;

/// Whether a name has such characters, or others that are not seen, by which two names would look
/// alike: soft hyphen; zero-width spaces, joiners and marks (U+200B to U+200F, U+061C, U+2060 to
/// U+206F, U+FEFF); line and paragraph separators; tags (U+E0000 to U+E007F).
bool hasInvisible(std::string_view text) noexcept;

/// The text without such characters, and without spaces at its ends.
std::string withoutInvisible(std::string_view text);

/// The text with U+FFFD in place of each such character, and of each byte that is of no character
/// of UTF-8, for lists: a file that another program named may have them, and they would turn the
/// line around, or hide.
std::string withVisible(std::string_view text);

/// The text with U+FFFD in place of each character that hasControls() finds, for a terminal.
std::string withVisibleControls(std::string_view text, std::string_view allowed = {});

} // namespace petrous::scene
