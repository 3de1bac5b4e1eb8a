#pragma once

#include <stdexcept>
#include <string>

namespace petrous::core
{

/// Category of an error as the user meets it; the command line maps it to an exit code.
enum class Fault
{
  BadInput,  ///< invalid file or value from outside (exit 3)
  Refused,   ///< not done because it would lose data, or as disk or memory do not suffice (exit 4)
  Cancelled, ///< cancelled by the user (exit 130)
  Internal   ///< defect of the program, or failure of the machine (exit 1)
};

/// Base of every exception that leaves a module.
///
/// The message is one line: the item, what is wrong with it, and what would be valid. It never
/// contains patient data.
class Error : public std::runtime_error
{
public:
  Error(Fault fault, const std::string& message);
  Fault fault() const noexcept { return m_fault; }

private:
  Fault m_fault;
};

/// A value outside its stated domain.
class InvalidParameter : public Error
{
public:
  explicit InvalidParameter(const std::string& message);
};

/// Thrown by Progress::check after the user has cancelled.
class CancelledError : public Error
{
public:
  explicit CancelledError(const std::string& task);
};

} // namespace petrous::core
