#pragma once

#include <memory>
#include <string>

class QLineEdit;

namespace petrous::workstation
{

constexpr int kShortestPassphrase = 8; // bytes

/// A line whose text is not shown, nor learnt by an input method. `name` is its object name.
QLineEdit* passphraseLine(const char* name);

/// Overwrites and empties it.
void clearPassphrase(QLineEdit& line);

/// Takes the passphrase out of the line; it is overwritten when the last reference goes.
std::shared_ptr<const std::string> takePassphrase(QLineEdit& line);

} // namespace petrous::workstation
