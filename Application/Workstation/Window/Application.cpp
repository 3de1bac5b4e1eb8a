#include "Application.h"

#include <algorithm>
#include <new>

#include <QEvent>
#include <QLabel>
#include <QSettings>
#include <QWidget>

#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Core/Error.h"
#include "petrous/Core/Log.h"

namespace petrous::workstation
{

namespace
{

// Queued: the receiver may be partly destroyed.
void notifyApplication(const QString& why)
{
  auto* application = qobject_cast<Application*>(QCoreApplication::instance());
  if (application)
    QMetaObject::invokeMethod(
        application, [application, why] { emit application->faulted(why); }, Qt::QueuedConnection);
}

// QMessageBox::setTextFormat does not reach the informative text, whose label is made with that,
// nor is there such a setting of tooltips. Labels are polished before they are measured or shown.
void showAsItIs(QObject* receiver)
{
  auto* label = qobject_cast<QLabel*>(receiver);
  if (label && label->textFormat() == Qt::AutoText)
    label->setTextFormat(Qt::PlainText);
}

} // namespace

Application::Application(int& argc, char** argv)
  : QApplication(argc, argv)
{
  // Where Qt's file dialogs keep the folders that were visited (QtProject.conf) cannot be: they
  // still open where the last one was closed, as long as the program runs.
  QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, "/dev/null");
}

bool Application::notify(QObject* receiver, QEvent* event)
{
  bool handled = false;
  guarded(
      [&]
      {
        if (event->type() == QEvent::Polish)
          showAsItIs(receiver);
        handled = QApplication::notify(receiver, event);
      });
  return handled;
}

bool isDialogOpen()
{
  const QWidgetList all = QApplication::topLevelWidgets();
  return QApplication::activePopupWidget() ||
         std::any_of(all.begin(), all.end(),
                     [](const QWidget* one) { return one->isModal() && one->isVisible(); });
}

void guarded(const std::function<void()>& work,
             const std::function<void(const QString&)>& notify) noexcept
{
  try
  {
    try
    {
      work();
    }
    catch (const std::exception& error)
    {
      notify(toString(error));
    }
    catch (...)
    {
      notify(QObject::tr("An unexpected fault."));
    }
  }
  catch (...) // no memory even for a message
  {
  }
}

void guarded(const std::function<void()>& work) noexcept
{
  guarded(work, notifyApplication);
}

QString toString(const std::exception& error)
{
  core::log::error("window: " + core::log::typeOf(error));
  if (dynamic_cast<const core::Error*>(&error))
    return windowText(words(error.what()));
  if (dynamic_cast<const std::bad_alloc*>(&error))
    return QObject::tr("There is not enough memory; close other programs.");
  return QObject::tr("An unexpected fault; the library is as it was before.");
}

} // namespace petrous::workstation
