#pragma once

#include <stdexcept>
#include <string>

namespace petrous::core
{

/// What an error means to the person who meets it; the command turns it into an exit code.
enum class Fault
{
  BadInput,  ///< a file or value from outside is wrong (exit 3)
  Refused,   ///< done would lose something, so it is not done (exit 4)
  Cancelled, ///< the user asked to stop (exit 4)
  Internal   ///< a fault of ours, or of the machine (exit 1)
};

/// Base of every exception that leaves a module.
///
/// The message is one line that names the thing, what is wrong with it and what would be right.
/// It never carries patient data.
class Error : public std::runtime_error
{
public:
  Error(Fault fault, const std::string& message);
  Fault fault() const noexcept { return m_fault; }

private:
  Fault m_fault;
};

/// A value out of its stated domain.
class InvalidParameter : public Error
{
public:
  explicit InvalidParameter(const std::string& message);
};

/// Thrown by Progress::check when the user has asked to stop.
class CancelledError : public Error
{
public:
  explicit CancelledError(const std::string& task);
};

} // namespace petrous::core
