#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include <QWidget>

#include "petrous/Presenters/ApproachComparison.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;
class QTableWidget;

namespace petrous::workstation
{

class ThreeDView;

/// Two approaches of a case: their pictures side by side, which turn together, or one with the
/// difference in colours, and a table.
class ComparisonWindow : public QWidget
{
  Q_OBJECT
public:
  explicit ComparisonWindow(QWidget* parent);

  /// Those that can be chosen, and the two that are compared.
  void setApproaches(const std::vector<std::string>& names,
                     const std::array<std::string, 2>& chosen);
  void setStamp(const QString& text);
  void setCamera(const core::CameraPose& camera);
  void setProgress(double fraction, const QString& left); ///< of comparing
  void fail(const QString& why);
  void stop(); ///< comparing was cancelled
  /// `contents`: the scene of the case; its mask is not used.
  void setComparison(const rendering::SceneContents& contents,
                     const std::shared_ptr<const presenters::ApproachComparison>& comparison);

  bool showsDifference() const;
  const std::array<ThreeDView*, 2>& views() const noexcept { return m_views; }
  QTableWidget& table() noexcept { return *m_table; }

signals:
  void cancelAsked();
  void againAsked();
  void approachesChosen(const QString& first, const QString& second); ///< names of the history
  void differenceToggled(bool on);
  void closed();

protected:
  void keyPressEvent(QKeyEvent* event) override;
  void closeEvent(QCloseEvent* event) override;

private:
  void showWork(bool working, const QString& fault);
  void draw();
  void stampViews();
  void fillTable();
  void addRow(const QString& what, const QString& first, const QString& second,
              const QString& tip = {});

  std::array<QComboBox*, 2> m_choices;
  std::array<ThreeDView*, 2> m_views;
  QCheckBox* m_difference;
  QLabel* m_legend;
  QLabel* m_fault;
  QPushButton* m_again; // beside the fault
  QProgressBar* m_progress;
  QPushButton* m_cancel; // beside the progress
  QTableWidget* m_table;
  QString m_stamp; // of the case
  rendering::SceneContents m_contents;
  std::shared_ptr<const presenters::ApproachComparison> m_comparison;
  bool m_isTurning = false;
};

} // namespace petrous::workstation
