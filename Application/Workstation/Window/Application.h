#pragma once

#include <functional>

#include <QApplication>

namespace petrous::workstation
{

/// Reports exceptions of event handlers instead of letting them escape: Qt's own loop would end the
/// program, and lose unsaved removal. Qt's file dialogs keep no folder in the user's settings:
/// folders of DICOM are named after patients. Labels, those of message boxes and tooltips too, show
/// their text as it is, unless they state Qt::RichText: names of cases, structures and files may
/// look like HTML, of which Qt would draw the formatting and read the images.
class Application : public QApplication
{
  Q_OBJECT
public:
  Application(int& argc, char** argv);

  bool notify(QObject* receiver, QEvent* event) override;

signals:
  void faulted(const QString& why); ///< queued; in order
};

/// A modal one, or a menu: what changes the case waits for its end.
bool isDialogOpen();

/// An exception as text; its type is logged. Messages of other libraries may contain patient data;
/// they are left out.
QString toString(const std::exception& error);

/// Runs what must not throw: a thread's function, a callback of another library. Exceptions are
/// passed to `notify` as text.
void guarded(const std::function<void()>& work,
             const std::function<void(const QString&)>& notify) noexcept;

/// As above, reporting via Application::faulted; thread-safe.
void guarded(const std::function<void()>& work) noexcept;

} // namespace petrous::workstation
