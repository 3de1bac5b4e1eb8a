#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include <QAbstractTableModel>
#include <QDialog>
#include <QPointer>
#include <QTimer>

#include "BackgroundWork.h"
#include "petrous/Library/PseudonymMap.h"

class QLabel;
class QLineEdit;
class QPushButton;
class QSortFilterProxyModel;
class QStackedWidget;
class QTableView;

namespace petrous::workstation
{

class PathRow;

/// The entries of a map as a table; it holds no copy of them.
class PseudonymsModel : public QAbstractTableModel
{
  Q_OBJECT
public:
  using QAbstractTableModel::QAbstractTableModel;

  void show(const library::PseudonymMap* map); ///< null: none; again after the map was changed

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

private:
  const library::PseudonymMap* m_map = nullptr;
};

/// Who is behind the pseudonyms (`petrous pseudonyms`): a map is opened by its passphrase,
/// searched, takes in another map, is copied under another passphrase, and gets another one. It is
/// locked when the dialog closes and after a time without input; nothing of it is kept or written
/// but to encrypted maps.
class PseudonymsDialog : public QDialog
{
  Q_OBJECT
public:
  explicit PseudonymsDialog(std::chrono::milliseconds lockAfter = std::chrono::minutes(5),
                            QWidget* parent = nullptr);
  ~PseudonymsDialog() override;

  bool isOpen() const noexcept { return m_map != nullptr; }

  void done(int result) override; ///< locks it

protected:
  bool eventFilter(QObject* watched, QEvent* event) override; ///< of the application: input

private:
  using Secret = std::shared_ptr<const std::string>; ///< overwritten when the last one goes
  using MapWork = std::function<BackgroundWork::Reply(library::PseudonymMap&)>;
  QWidget* lockedPage();
  QWidget* openPage();
  void open();
  void lock(const QString& why);
  void take();
  void copy();
  void change();
  /// Asks for another map's file (none where `title` is empty) and a passphrase, typed twice if it
  /// is a `fresh` one. False: the user does not want to.
  bool ask(const QString& title, const QString& text, bool fresh, QString* file, Secret& secret);
  /// Runs it on the open map in a separate thread: entries are only read there.
  void work(const QString& text, MapWork task);
  void say(const QString& text);
  void update();

  std::chrono::milliseconds m_lockAfter;
  std::shared_ptr<library::PseudonymMap> m_map;
  PseudonymsModel m_entries;
  QSortFilterProxyModel* m_found;
  QStackedWidget* m_pages;
  PathRow* m_file;
  QLineEdit* m_passphrase;
  QPushButton* m_open;
  QLineEdit* m_search;
  QTableView* m_table;
  QPushButton* m_take;
  QPushButton* m_copy;
  QPushButton* m_change;
  QPushButton* m_lock;
  QLabel* m_outcome;
  QTimer m_idle;
  QPointer<QDialog> m_asked; ///< the dialog that asks for another passphrase
  BackgroundWork m_work;
};

} // namespace petrous::workstation
