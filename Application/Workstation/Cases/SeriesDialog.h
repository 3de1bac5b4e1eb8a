#pragma once

#include <optional>
#include <vector>

#include <QDialog>

#include "petrous/Core/AxesCorrection.h"
#include "petrous/Presenters/SourceContent.h"

class QCheckBox;
class QLabel;
class QPushButton;
class QTreeWidget;
class QTreeWidgetItem;

namespace petrous::workstation
{

/// The series and volumes of a DICOM folder with their verdicts, and structures and meshes beside
/// them, to be ticked: at most one CT, which begins a case, and any number of the others.
class SeriesDialog : public QDialog
{
  Q_OBJECT
public:
  /// `hasCase`: an MR alone can be chosen for the open case.
  SeriesDialog(const presenters::SourceContent& source, bool hasCase, QWidget* parent = nullptr);

  std::vector<presenters::SeriesContent> chosen() const;
  /// Of each of them, where its file is wrong; nullopt: of an image as it states them, of
  /// structures and meshes as those of their image.
  std::vector<std::optional<core::AxesCorrection>> axes() const;
  bool wantsRegion() const; ///< a region of each image is to be chosen before it is read

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  void addAxes(QTreeWidgetItem& line, const presenters::SeriesContent& series);
  bool isChosen(std::size_t series) const;
  void proposeTicks();
  void keepOneCt(QTreeWidgetItem& changed);
  void check();

  std::vector<presenters::SeriesContent> m_series;
  bool m_hasCase;
  QTreeWidget* m_list;
  QCheckBox* m_region;
  QLabel* m_advice;
  QPushButton* m_open;
};

} // namespace petrous::workstation
