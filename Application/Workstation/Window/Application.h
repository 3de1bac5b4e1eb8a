#pragma once

#include <functional>

#include <QApplication>

namespace petrous::workstation
{

/// The application, out of whose event handlers no exception gets: it is told instead, and the
/// window goes on. Qt's own loop would end the program, and what was drilled with it.
class Application : public QApplication
{
  Q_OBJECT
public:
  Application(int& argc, char** argv);

  bool notify(QObject* receiver, QEvent* event) override;

signals:
  void faulted(const QString& why); ///< queued; in the order in which they came
};

/// An exception in words. Texts of other libraries may carry patient data; they are left out.
QString toString(const std::exception& error);

/// Runs what must not throw: the whole of a thread, a callback of another library. What it throws
/// is told by `tell`, in words.
void guarded(const std::function<void()>& work,
             const std::function<void(const QString&)>& tell) noexcept;

/// The same, told where the application tells its own (Application::faulted), from any thread.
void guarded(const std::function<void()>& work) noexcept;

} // namespace petrous::workstation
