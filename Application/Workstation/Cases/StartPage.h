#pragma once

#include <functional>
#include <string>
#include <vector>

#include <QWidget>

#include "BackgroundWork.h"
#include "petrous/Library/Library.h"

class QLabel;
class QListView;

namespace petrous::presenters
{
class WorkstationModel;
}

namespace petrous::workstation
{

class CasesModel;

/// Shown while no case is open: ways to begin, and the cases that were changed last.
class StartPage : public QWidget
{
  Q_OBJECT
public:
  explicit StartPage(const presenters::WorkstationModel& model, QWidget* parent = nullptr);

  void refresh(); ///< what the library has, when it is next seen
  bool isReading() const noexcept { return m_work.busy(); }
  void pictureDrawn(const std::string& id);
  /// Something is being read: that is said, and nothing else can be begun. Empty: no longer.
  void setBusy(const QString& what);
  /// Hears which cases are seen.
  void onSeen(std::function<void(const library::CaseSummary&)> seen);

signals:
  void openFolderAsked();
  void openCaseAsked();
  void restoreAsked();
  void sampleAsked();
  void caseAsked(const QString& name);

protected:
  void showEvent(QShowEvent* event) override;

private:
  void list(); ///< in a separate thread
  void showCases(std::vector<library::CaseSummary> cases);
  void open(int row);
  void tell(const QString& trouble); ///< empty: there is none

  const presenters::WorkstationModel& m_model;
  CasesModel* m_cases;
  QLabel* m_heading;
  QLabel* m_trouble;
  QLabel* m_busy;
  QWidget* m_place = nullptr; ///< the buttons
  QListView* m_recent;
  QWidget* m_begin;               ///< has the focus where there is no case
  bool m_takesFocus = false;      ///< when it is listed
  std::function<void()> m_listed; ///< called when it is
  BackgroundWork m_work;
};

} // namespace petrous::workstation
