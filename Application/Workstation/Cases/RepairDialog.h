#pragma once

#include <QDialog>

#include "petrous/Presenters/SeriesPreview.h"
#include "petrous/Presenters/SourceContent.h"

class QLabel;

namespace petrous::workstation
{

class PreviewBar;
class SliceView;

/// Asks for consent to repair a series: what is wrong, the stack from the side as its slices lie in
/// the files and as straightened, and what remains uncertain. The pictures come from another
/// thread.
class RepairDialog : public QDialog
{
  Q_OBJECT
public:
  /// `series`: what the user calls it.
  RepairDialog(const presenters::SourceContent& source, const QString& series,
               QWidget* parent = nullptr);

  bool isPictured() const noexcept { return m_isPictured; }     ///< the pictures are shown
  bool wantsAnother() const noexcept { return m_wantsAnother; } ///< rejected for another scan

private:
  void show(const presenters::RepairPreview& preview);

  QLabel* m_remains;
  PreviewBar* m_progress;
  QWidget* m_pictures;
  bool m_isPictured = false;
  bool m_wantsAnother = false;
};

} // namespace petrous::workstation
