#pragma once

#include <functional>
#include <set>
#include <string>

#include "BackgroundWork.h"
#include "Panels.h"
#include "petrous/Library/Library.h"

class QBoxLayout;
class QCheckBox;
class QComboBox;
class QDateEdit;
class QGridLayout;
class QLabel;
class QLineEdit;
class QMenu;
class QToolButton;
class QTreeView;

namespace petrous::presenters
{
class WorkstationModel;
}

namespace petrous::workstation
{

class CasesModel;

/// The cases of the library: searched as one types (Ctrl+F in the panel), opened (Enter), renamed
/// (F2), copied (Ctrl+C), deleted (Del), brought back; archived and sent. It asks for changes, and
/// shows what the library has then (`refresh`). The library is read in a separate thread; a search
/// that another one follows is cancelled.
class LibraryPanel : public Panel
{
  Q_OBJECT
public:
  explicit LibraryPanel(const presenters::WorkstationModel& model, QWidget* parent = nullptr);

  std::string current() const; ///< the selected case, damaged or not; empty: none
  std::string chosen() const;  ///< the same, if it can be opened
  std::size_t strokes() const; ///< of the selected case

  void refreshSoon(); ///< when it is next seen

  void refresh();
  bool isReading() const noexcept { return m_work.busy(); } ///< the list is not yet what is asked
  void forgetPictures();
  void pictureDrawn(const std::string& id);
  /// Hears which cases of the list are seen.
  void onSeen(std::function<void(const library::CaseSummary&)> seen);
  /// To the menu *More*: what the window's menus do with the library as a whole.
  void addToMore(const QList<QAction*>& actions);
  void select(const std::string& name); ///< also where the search hides it
  void focusList();
  QWidget* mainControl() override;

  void caseChanged() override { refreshSoon(); }

signals:
  void refreshed();
  void openAsked(const QString& name);
  void renameAsked(const QString& name);
  void copyAsked(const QString& name);
  void removeAsked(const QString& name);
  void describeAsked(const QString& name);
  void pictureAsked(const QString& name);
  void archiveAsked(const QString& name);
  void sendAsked(const QString& name);
  void undeleteAsked(const QString& name);

protected:
  void showEvent(QShowEvent* event) override;
  bool event(QEvent* event) override; ///< Ctrl+F is the panel's own while it has the focus

private:
  using Asked = void (LibraryPanel::*)(const QString&);
  bool isFiltered() const;
  void addButtons(QGridLayout& layout);
  void addFilters(QBoxLayout& layout);
  library::CaseFilter filter() const;
  struct Found
  {
    std::vector<library::CaseSummary> cases;
    std::set<std::string> tags; ///< of all cases
    std::vector<library::DeletedCase> deleted;
    bool isFiltered = false;
  };
  void listTags(const std::set<std::string>& tags);
  void listDeleted(const std::vector<library::DeletedCase>& cases);
  void showFound(Found found);
  void showFault(const QString& why);
  void update();

  const presenters::WorkstationModel& m_model;
  CasesModel* m_cases;
  QLineEdit* m_search;
  QComboBox* m_side;
  QComboBox* m_tag;
  QCheckBox* m_inNotes;
  QCheckBox* m_dated;
  QDateEdit* m_from;
  QDateEdit* m_to;
  QTreeView* m_list;
  QLabel* m_count;
  QMenu* m_more;
  QMenu* m_deleted;
  QToolButton* m_undelete;
  QList<QAction*> m_needCase;  ///< that can be opened
  QList<QAction*> m_needEntry; ///< damaged or not
  std::string m_before;        ///< the selected case, while the list changes
  std::string m_open;          // when the list was shown last
  std::string m_wanted;        ///< to be selected when the list is read; empty: as before
  bool m_stale = true;
  BackgroundWork m_work;
};

} // namespace petrous::workstation
