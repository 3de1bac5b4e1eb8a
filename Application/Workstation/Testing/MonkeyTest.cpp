#include "GuiTest.h"

#include <algorithm>
#include <deque>
#include <fstream>
#include <memory>
#include <random>

#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QDrag>
#include <QElapsedTimer>
#include <QFileDialog>
#include <QLineEdit>
#include <QMenu>
#include <QMimeData>
#include <QProgressDialog>
#include <QPushButton>
#include <QSpinBox>

#include "Banner.h"
#include "EventLoopWatchdog.h"
#include "petrous/Imaging/LabelFile.h"
#include "petrous/Imaging/MeshFile.h"
#include "petrous/Imaging/VolumeFile.h"

using namespace petrous;
using namespace petrous::workstation;
namespace fs = std::filesystem;

namespace
{

// A user without a plan: actions, keys, clicks, drags, wheel, drops and answers to dialogs by
// chance, of a seed. PETROUS_MONKEY=10000: that many; PETROUS_MONKEY_SEED: another way.
class Monkey : public GuiTest
{
protected:
  void SetUp() override
  {
    // What is written by chance is written here.
    qputenv("HOME", QByteArray::fromStdString(folder().string()));
    QApplication::setQuitOnLastWindowClosed(false); // which would end the loops of dialogs
    m_before = QDir::currentPath();
    QDir::setCurrent(QString::fromStdString(folder().string()));
    m_chance.seed(qEnvironmentVariable("PETROUS_MONKEY_SEED", "20").toUInt());
    writeFiles();
  }
  void TearDown() override { QDir::setCurrent(m_before); }

  void openAny(const QString& what = {})
  {
    openWindow(what);
    // Takes long, and much memory.
    for (auto* button : window().findChildren<QPushButton*>())
      if (button->text() == kSample)
        button->setEnabled(false);
  }
  static bool mayBeChosen(const QAction& action)
  {
    const QString text = action.text().remove('&');
    return action.isEnabled() && !action.isSeparator() && !action.menu() && text != "Quit" &&
           text != kSample;
  }

  int upTo(int count) // 0 to count - 1
  {
    return static_cast<int>(m_chance() % static_cast<unsigned>(std::max(count, 1)));
  }
  bool inHundred(int percent) { return upTo(100) < percent; }
  template <class List>
  auto oneOf(const List& list)
  {
    return list[static_cast<typename List::size_type>(upTo(static_cast<int>(list.size())))];
  }

  void writeFiles()
  {
    const scene::Case ball = ballCase("x");
    imaging::writeVolume(folder() / "ear.nrrd", *ball.ct.volume.get());
    imaging::writeLabelFile(folder() / "labels.seg.nrrd", *ball.labels[0].labels.get());
    core::TriangleMesh mesh;
    for (const auto& corner : {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(6, 0, 0),
                               Eigen::Vector3f(0, 6, 0), Eigen::Vector3f(0, 0, 6)})
      mesh.vertices.push_back(corner + kBallCenter.cast<float>());
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    imaging::writeMesh(folder() / "incus.stl", mesh);
    std::ofstream(folder() / "garbage.nii.gz", std::ios::binary) << std::string(5000, '\x1f');
    std::ofstream(folder() / "letter.pdf") << "%PDF-1.4 not much";
    fs::create_directory(folder() / "empty");
    scene::Case other = ballCase("with an MR");
    other.mr.push_back(other.ct);
    other.mr.back().name = "T2";
    library().save(other);
    saveBall("ball");
  }

  void did(const QString& what)
  {
    m_done.push_back(what.toStdString());
    if (m_done.size() > 25)
      m_done.pop_front();
    if (qEnvironmentVariableIsSet("PETROUS_MONKEY"))
      std::fprintf(stderr, "%d %s\n", m_count, what.toUtf8().constData());
  }
  std::string lately() const
  {
    std::string text;
    for (const std::string& one : m_done)
      text += "\n  " + one;
    return text;
  }

  QPoint within(const QWidget& widget) { return {upTo(widget.width()), upTo(widget.height())}; }
  Qt::KeyboardModifiers modifiers()
  {
    static const std::vector<Qt::KeyboardModifiers> all{Qt::NoModifier,
                                                        Qt::NoModifier,
                                                        Qt::NoModifier,
                                                        Qt::ShiftModifier,
                                                        Qt::AltModifier,
                                                        Qt::ControlModifier,
                                                        Qt::ControlModifier | Qt::ShiftModifier};
    return oneOf(all);
  }
  static bool isFileDialog(const QWidget* widget)
  {
    for (; widget; widget = widget->parentWidget())
      if (qobject_cast<const QFileDialog*>(widget))
        return true;
    return false;
  }

  void clickWithin(QWidget& top)
  {
    std::vector<QWidget*> all{&top};
    for (QWidget* one : top.findChildren<QWidget*>())
      if (one->isVisible() && one->isEnabled() && one->window() == &top)
        all.push_back(one);
    const QPointer<QWidget> target = oneOf(all);
    const QPoint at = within(*target);
    const Qt::MouseButton button = inHundred(80)   ? Qt::LeftButton
                                   : inHundred(70) ? Qt::RightButton
                                                   : Qt::MiddleButton;
    const Qt::KeyboardModifiers keys = modifiers();
    const int kind = upTo(10);
    did(QString("%1 %2 on %3 “%4” at %5,%6")
            .arg(kind < 6   ? "click"
                 : kind < 7 ? "double click"
                 : kind < 9 ? "drag"
                            : "wheel")
            .arg(int(button))
            .arg(target->metaObject()->className(), target->objectName())
            .arg(at.x())
            .arg(at.y()));
    if (kind < 6)
    {
      QTest::mousePress(target, button, keys, at);
      if (target)
        QTest::mouseRelease(target, button, keys, at);
      return;
    }
    if (kind < 7)
      return QTest::mouseDClick(target, button, keys, at);
    if (kind == 9)
    {
      QWheelEvent wheel(at, target->mapToGlobal(at), {}, {0, inHundred(50) ? 120 : -240},
                        Qt::NoButton, keys, Qt::NoScrollPhase, false);
      QApplication::sendEvent(target, &wheel);
      return;
    }
    const QScopedValueRollback<bool> dragging(m_dragging, true);
    QTest::mouseMove(target, at);
    QTest::mousePress(target, button, keys, at);
    for (int n = 0; n < 5 && target; ++n)
    {
      const QPoint to = within(*target);
      QMouseEvent move(QEvent::MouseMove, to, target->mapToGlobal(to), button, button, keys);
      QApplication::sendEvent(target, &move);
      QTest::qWait(upTo(20));
    }
    if (target)
      QTest::mouseRelease(target, button, keys, within(*target));
  }

  void pressKey(QWidget& top)
  {
    static const std::vector<int> keys{
        Qt::Key_Tab,    Qt::Key_Backtab, Qt::Key_Return, Qt::Key_Escape,     Qt::Key_Space,
        Qt::Key_Delete, Qt::Key_Left,    Qt::Key_Right,  Qt::Key_Up,         Qt::Key_Down,
        Qt::Key_Home,   Qt::Key_End,     Qt::Key_PageUp, Qt::Key_PageDown,   Qt::Key_Backspace,
        Qt::Key_F1,     Qt::Key_F2,      Qt::Key_F3,     Qt::Key_F4,         Qt::Key_F5,
        Qt::Key_F6,     Qt::Key_F7,      Qt::Key_F8,     Qt::Key_F9,         Qt::Key_F10,
        Qt::Key_Comma,  Qt::Key_Period,  Qt::Key_Minus,  Qt::Key_BracketLeft};
    const int key = inHundred(50)   ? oneOf(keys)
                    : inHundred(70) ? Qt::Key_A + upTo(26)
                                    : Qt::Key_0 + upTo(10);
    const Qt::KeyboardModifiers with = modifiers();
    const bool quits = (with & Qt::ControlModifier) && key == Qt::Key_Q;
    if (quits || (with & Qt::AltModifier && key == Qt::Key_F4))
      return;
    QWidget* focus = QApplication::focusWidget();
    const QPointer<QWidget> to = focus && focus->window() == &top ? focus : &top;
    did("key " + QKeySequence(key + int(with)).toString() + " to " + to->metaObject()->className() +
        " " + to->objectName());
    QTest::keyPress(to, static_cast<Qt::Key>(key), with);
    if (to)
      QTest::keyRelease(to, static_cast<Qt::Key>(key), with);
  }

  void triggerAction()
  {
    std::vector<QAction*> all;
    for (QAction* one : window().findChildren<QAction*>())
      if (mayBeChosen(*one))
        all.push_back(one);
    QAction* chosen = oneOf(all);
    did("action " + chosen->text());
    chosen->trigger();
  }

  void dropSomething()
  {
    static const std::vector<std::string> names{"ear.nrrd",       "labels.seg.nrrd", "incus.stl",
                                                "garbage.nii.gz", "letter.pdf",      "empty",
                                                "no such file",   "library"};
    QMimeData data;
    QList<QUrl> urls;
    QString told = "drop";
    for (int n = upTo(2); n >= 0; --n)
    {
      const std::string name = oneOf(names);
      urls += QUrl::fromLocalFile(QString::fromStdString((folder() / name).string()));
      told += " " + QString::fromStdString(name);
    }
    data.setUrls(urls);
    did(told);
    QDragEnterEvent enter({300, 300}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&window(), &enter);
    QDropEvent event(QPointF(300, 300), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&window(), &event);
  }

  void openAnotherCase()
  {
    const auto cases = library().list();
    if (cases.empty() || window().busy())
      return;
    const std::string name = oneOf(cases).name;
    did("case " + QString::fromStdString(name));
    window().begin(QString::fromStdString(name));
  }

  void setNumber()
  {
    std::vector<QAbstractSpinBox*> boxes;
    for (auto* box : window().findChildren<QAbstractSpinBox*>())
      if (box->isEnabled() && box->isVisible())
        boxes.push_back(box);
    if (boxes.empty())
      return;
    QAbstractSpinBox* box = oneOf(boxes);
    did("number " + box->objectName());
    const double at = upTo(1001) / 1000.0;
    if (auto* number = qobject_cast<QDoubleSpinBox*>(box))
      number->setValue(number->minimum() + at * (number->maximum() - number->minimum()));
    else if (auto* whole = qobject_cast<QSpinBox*>(box))
      whole->setValue(whole->minimum() +
                      static_cast<int>(at * (whole->maximum() - whole->minimum())));
  }

  void act()
  {
    QApplication::setActiveWindow(&window());
    const int kind = upTo(100);
    if (kind < 40)
      triggerAction();
    else if (kind < 60)
      clickWithin(window());
    else if (kind < 80)
      pressKey(window());
    else if (kind < 88)
      setNumber();
    else if (kind < 92)
      dropSomething();
    else if (kind < 96)
      openAnotherCase();
    else if (kind < 99)
      othersToo();
    else if (!window().busy())
    {
      did("the window is closed, and another opened");
      closeWindow();
      openAny();
    }
  }

  /// Key list, surgeon's window, reports.
  void othersToo()
  {
    for (QWidget* top : QApplication::topLevelWidgets())
      if (top != &window() && top->isVisible() && top->windowType() != Qt::ToolTip &&
          !isFileDialog(top))
      {
        did(QString("other window ") + top->metaObject()->className());
        if (inHundred(50))
          top->close();
        else
          clickWithin(*top);
        return;
      }
  }

  /// A timer that is being answered does not fire again: each has another.
  void answerSoon(QObject& answers)
  {
    QTimer::singleShot(15, &answers,
                       [this, &answers]
                       {
                         answerSoon(answers);
                         lookForStandstill();
                         if (m_answers)
                           answer();
                       });
  }

  /// Events come, but the action does not end: a loop within it waits for what never happens.
  void lookForStandstill()
  {
    constexpr int kStandstill = 300000; // ms
    if (!m_actionFor.hasExpired(kStandstill))
      return;
    const auto nameOf = [](const QWidget* widget)
    {
      return widget ? std::string(widget->metaObject()->className()) + " '" +
                          widget->objectName().toStdString() + "'"
                    : std::string("none");
    };
    std::fprintf(stderr, "standstill: modal %s, popup %s, answered %s, dragging %d, after%s\n",
                 nameOf(QApplication::activeModalWidget()).c_str(),
                 nameOf(QApplication::activePopupWidget()).c_str(), nameOf(m_present).c_str(),
                 m_dragging, lately().c_str());
    std::abort(); // whose handler prints where
  }

  /// Whatever is modal, or pops up. Some rounds of anything, then a way out.
  void answer()
  {
    if (m_dragging)
      QDrag::cancel(); // would wait for the true pointer
    QWidget* popup = QApplication::activePopupWidget();
    QWidget* present = popup ? popup : QApplication::activeModalWidget();
    if (!present || present == m_present) // an answer may bring another one
      return;
    const QScopedValueRollback<QPointer<QWidget>> answering(m_present, present);
    if (popup)
    {
      if (auto* menu = qobject_cast<QMenu*>(popup); menu && inHundred(50))
      {
        std::vector<QAction*> all;
        for (QAction* one : menu->actions())
          if (mayBeChosen(*one))
            all.push_back(one);
        if (!all.empty())
        {
          QAction* chosen = oneOf(all);
          did("  menu " + chosen->text());
          menu->setActiveAction(chosen);
          QTest::keyClick(menu, Qt::Key_Return);
          return;
        }
      }
      did(QString("  popup closed ") + popup->metaObject()->className());
      popup->close();
      return;
    }
    const QPointer<QWidget> modal = QApplication::activeModalWidget();
    if (auto* progress = qobject_cast<QProgressDialog*>(modal.data()))
    {
      if (inHundred(3))
      {
        did("  progress cancelled");
        for (auto* button : progress->findChildren<QPushButton*>())
          button->click();
      }
      return;
    }
    if (modal != m_modal)
    {
      m_modal = modal;
      m_rounds = 0;
    }
    if (auto* files = qobject_cast<QFileDialog*>(modal.data()))
    {
      static const std::vector<const char*> names{"ear.nrrd", "labels.seg.nrrd", "new",
                                                  "letter.pdf", "empty"};
      const bool takes = inHundred(50);
      did(QString("  file dialog ") + (takes ? "taken" : "given up"));
      if (!takes)
        return files->reject();
      files->setDirectory(QString::fromStdString(folder().string()));
      files->selectFile(oneOf(names));
      static_cast<QDialog*>(files)->done(QDialog::Accepted);
      return;
    }
    ++m_rounds;
    if (auto* box = qobject_cast<QMessageBox*>(modal.data()))
    {
      const QList<QAbstractButton*> buttons = box->buttons();
      if (buttons.isEmpty())
        return box->reject();
      QAbstractButton* chosen = oneOf(buttons);
      did("  message “" + box->text().left(70) + "”: " + chosen->text());
      return chosen->click();
    }
    if (m_rounds > 12)
    {
      did(QString("  dialog given up ") + modal->metaObject()->className());
      if (auto* dialog = qobject_cast<QDialog*>(modal.data()))
        dialog->reject();
      else
        modal->close();
      return;
    }
    if (m_rounds > 3 && inHundred(25))
      for (auto* button : modal->findChildren<QPushButton*>())
        if (button->isDefault() && button->isEnabled())
        {
          did("  default button " + button->text());
          return button->click();
        }
    if (inHundred(25))
    {
      std::vector<QLineEdit*> lines;
      for (auto* line : modal->findChildren<QLineEdit*>())
        if (line->isEnabled() && line->isVisible() && !line->isReadOnly())
          lines.push_back(line);
      if (lines.empty())
        return;
      QLineEdit* line = oneOf(lines);
      did("  typed in " + line->objectName());
      line->setText(QString("a%1").arg(upTo(1000)));
      return;
    }
    inHundred(50) ? pressKey(*modal) : clickWithin(*modal);
  }

  /// `step` that many times, in the open window, while dialogs are answered.
  void play(int count, const std::function<void()>& step)
  {
    m_actionFor.start();
    auto answers = std::make_unique<QObject>();
    answerSoon(*answers);
    for (m_count = 0; m_count < count; ++m_count)
    {
      m_actionFor.start();
      step();
      QTest::qWait(upTo(12));
      // An exception that nobody expected.
      auto* fault = window().findChild<Banner*>("faultBanner");
      if (fault && !fault->isHidden())
      {
        ADD_FAILURE() << fault->text().toStdString() << " after" << lately();
        fault->hide();
      }
      if (!window().isVisible())
        window().show();
    }
    m_actionFor.start();
    EXPECT_TRUE(waitFor([this] { return !window().busy(); })) << lately();
    m_answers = false;
    for (QWidget* modal = QApplication::activeModalWidget(); modal;
         modal = QApplication::activeModalWidget())
    {
      modal->close();
      QTest::qWait(10);
      if (modal == QApplication::activeModalWidget())
        break;
    }
    m_answers = true; // a draft may be asked about
    closeWindow();
    answers.reset();
    for (const auto& one : library().list())
      EXPECT_NO_THROW(library().open(one.name)) << one.name;
  }

  static constexpr const char* kSample = "Make the sample patient";
  std::mt19937 m_chance;
  std::deque<std::string> m_done;
  QPointer<QWidget> m_modal;
  QString m_before;
  int m_count = 0;
  QElapsedTimer m_actionFor;
  int m_rounds = 0;            // with m_modal
  QPointer<QWidget> m_present; // is being answered; another one may come to lie where it was
  bool m_dragging = false;
  bool m_answers = true;
};

} // namespace

TEST_F(Monkey, NeverCrashesHangsOrFails)
{
  EventLoopWatchdog watchdog(60.0);
  watchdog.begin("a user without a plan");
  openAny("ball");
  play(qEnvironmentVariable("PETROUS_MONKEY", "150").toInt(), [this] { act(); });
}

// A menu or the palette may be open while a job opens another case.
TEST_F(Monkey, WhatMenusOfferedForACaseDoesNoHarmWithoutIt)
{
  openAny("with an MR");
  ASSERT_TRUE(waitFor([this] { return !window().busy(); }));
  for (QMenu* menu : window().findChildren<QMenu*>())
    emit menu->aboutToShow();
  std::deque<QPointer<QAction>> offered;
  for (QAction* one : window().findChildren<QAction*>())
    if (mayBeChosen(*one))
      offered.push_back(one);
  action("Close the case")->trigger();
  ASSERT_TRUE(waitFor([this] { return !action("Save")->isEnabled(); }));
  std::shuffle(offered.begin(), offered.end(), m_chance);
  int triggered = 0;
  play(static_cast<int>(offered.size()),
       [&]
       {
         const QPointer<QAction> one = offered.front();
         offered.pop_front();
         if (!one || !mayBeChosen(*one))
           return;
         did("action " + one->text());
         ++triggered;
         one->trigger();
       });
  EXPECT_GT(triggered, 100);
}
