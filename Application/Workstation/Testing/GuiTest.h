#pragma once

#include <functional>
#include <memory>

#include <gtest/gtest.h>

#include <QAbstractSpinBox>
#include <QAction>
#include <QImage>
#include <QJsonObject>
#include <QMessageBox>
#include <QModelIndex>
#include <QTemporaryDir>
#include <QTranslator>
#include <QtTest>

#include "Language.h"
#include "MainWindow.h"
#include "ThreeDView.h"
#include "petrous/Library/Library.h"

class QTreeView;

namespace petrous::workstation
{

/// A window on a library of its own. The patient is a sphere of bone, 12 mm in radius, at
/// kBallCenter, with a structure "nerve" inside.
class GuiTest : public ::testing::Test
{
protected:
  GuiTest();
  ~GuiTest() override;

  static const Eigen::Vector3d kBallCenter;
  static constexpr double kBallRadius = 12.0;

  std::filesystem::path folder() const; ///< initially empty, removed with the test
  library::Library library() const;
  static scene::Case ballCase(const std::string& name);
  void saveBall(const std::string& name); ///< into the library
  /// A CT whose headers state 12 bits of 16, of 40 with a pixel of 5000; `hasAir`: and with one of
  /// -1000 whose sign has no copies in the other bits. Returns its files.
  static std::vector<std::filesystem::path> writeUndeclaredBits(const std::filesystem::path& folder,
                                                                bool hasAir = false);

  presenters::DeviceSources devices;         ///< of windows opened later; initially none
  int drawThumbnailsAfter = -1;              ///< ms, see WindowOptions; of windows opened later
  int lookForDevicesEvery = 50;              ///< likewise
  int saveAfter = -1;                        ///< likewise
  bool isSafe = false;                       ///< likewise
  void openWindow(const QString& what = {}); ///< the pointer is beside it
  void closeWindow();
  MainWindow& window() { return *m_window; }
  ThreeDView& view();
  QAction* action(const QString& text); ///< by its text, without the ampersand
  QTreeView& structureList();
  /// Its cell in the list of structures; bone is "ct".
  QModelIndex structureCell(const std::string& part, int column = 0);
  QImage picture(); ///< of the 3D view, when static

  void drop(const QMimeData& data);
  void dropPath(const std::filesystem::path& path);
  /// Drills from the view's middle until something is removed and then for `milliseconds`, moving
  /// right by `pixels`: on a busy machine all of that time may pass before the burr cuts.
  void drill(int milliseconds, int pixels = 0);
  bool cuts();       ///< waits until the drill, which is on, has removed something
  void leave();      ///< the pointer, wherever it is, counts as outside of the view
  bool strokeEnds(); ///< after the drill was released: removed in a separate thread, and saved
  bool settled();    ///< nothing is being read or written

  /// Begins a recording in the file that the dialog offers; returns it.
  std::filesystem::path record();
  /// What the command says ("replay") when it plays a recording on that case of the library.
  QJsonObject replayed(const std::filesystem::path& file, const QString& name) const;

  /// Calls `react` with the next message box (polling), which must close it.
  void onMessage(const std::function<void(QMessageBox&)>& react);
  static void clickOn(QMessageBox& box, QMessageBox::ButtonRole role); ///< the first one
  /// Polls `react` with the dialog that is open, until it returns true. Progress is no dialog here.
  void onDialog(const std::function<bool(QDialog&)>& react);
  static bool waitFor(const std::function<bool()>& done, int milliseconds = 60000);
  /// Mnemonics that two parts of a scope have, with their texts: entries of a menu or menu bar, or
  /// what a dialog shows of buttons, group boxes, tabs and labels of a box.
  static QStringList sharedMnemonics(const QWidget& scope);
  /// What is shown once it has not changed for 400 ms: panels, banners and text come later.
  static QImage steady(const std::function<QImage()>& picture);

private:
  QTemporaryDir m_folder;
  std::unique_ptr<MainWindow> m_window;
};

/// As long as German texts are, at least.
class LongTexts : public QTranslator
{
public:
  bool isEmpty() const override { return false; }
  QString translate(const char* context, const char* text, const char*, int) const override
  {
    if (!QByteArray(context).startsWith("petrous"))
      return {};
    const QString plain = QString::fromUtf8(text);
    return plain + QString(plain.size() * 2 / 5, 'n');
  }
};

/// While it lives, texts are German.
class GermanTexts
{
public:
  GermanTexts()
  {
    m_isThere = m_texts.load(":/translations/petrous_de.qm");
    QApplication::installTranslator(&m_texts);
    useNumberLocale();
  }
  ~GermanTexts()
  {
    QApplication::removeTranslator(&m_texts);
    useNumberLocale();
  }
  GermanTexts(const GermanTexts&) = delete;
  GermanTexts& operator=(const GermanTexts&) = delete;
  bool isThere() const { return m_isThere; }

private:
  QTranslator m_texts;
  bool m_isThere = false;
};

/// Types a number over the one that a field has, and ends it.
void enterNumber(QAbstractSpinBox& box, const char* typed, Qt::Key end = Qt::Key_Enter);

/// Pixels that differ by more than `tolerance` in a channel.
int differentPixels(const QImage& a, const QImage& b, int tolerance = 2);
/// Of letters, whose outlines Qt smooths a little differently each time: a tolerance for pictures
/// that are to be equal, far below any colour that counts.
constexpr int kSmoothing = 8;
int pixelsUnlikeTheCorner(const QImage& image);

} // namespace petrous::workstation
