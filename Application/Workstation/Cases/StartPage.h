#pragma once

#include <functional>
#include <string>

#include <QWidget>

class QLabel;
class QListView;

namespace petrous::presenters
{
class WorkstationModel;
}

namespace petrous::library
{
struct CaseSummary;
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
  void pictureDrawn(const std::string& id);
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
  void list();
  void open(int row);
  void tell(const QString& trouble); ///< empty: there is none

  const presenters::WorkstationModel& m_model;
  CasesModel* m_cases;
  QLabel* m_heading;
  QLabel* m_trouble;
  QListView* m_recent;
  QWidget* m_begin; ///< has the focus where there is no case
};

} // namespace petrous::workstation
