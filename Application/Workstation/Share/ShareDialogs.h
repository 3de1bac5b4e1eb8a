#pragma once

#include <string>
#include <vector>

#include <QDialog>

#include "petrous/Core/CameraPose.h"
#include "petrous/Presenters/PlanReport.h"
#include "petrous/Rendering/PrintPicture.h"
#include "petrous/Rendering/SceneContents.h"
#include "petrous/Scene/Case.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QLabel;
class QPushButton;
class QSpinBox;

namespace petrous::workstation
{

class PathRow;

/// A dialog that ends in a file to be written.
class ShareDialog : public QDialog
{
  Q_OBJECT
public:
  std::filesystem::path file() const;

protected:
  /// `name`: object name of the dialog, of which "NameFile" is that of the path's line.
  ShareDialog(const char* name, const QString& title, const QString& accept, QWidget* parent);

  void setFile(const QString& file);
  /// Why it cannot be written, beyond the folder that has to be there; empty: it can.
  virtual QString problem() const { return {}; }
  virtual std::vector<std::filesystem::path> files() const { return {file()}; }
  void check();

  QFormLayout* m_form;
  QLabel* m_note;

private:
  void askAndAccept();

  PathRow* m_path;
  QLabel* m_advice;
  QPushButton* m_accept;
};

/// `petrous report`.
class ReportDialog : public ShareDialog
{
  Q_OBJECT
public:
  /// leftOut: of damaged structures, WorkstationModel::leftOut.
  /// `ofView`: the background of the 3D view.
  ReportDialog(const scene::Case& value, const rendering::BackgroundColor& ofView,
               const std::vector<std::string>& leftOut = {}, QWidget* parent = nullptr);

  presenters::ReportOptions options() const; ///< without mayIdentify
  bool isPdf() const;

protected:
  QString problem() const override;

private:
  QComboBox* m_approach;
  QComboBox* m_language;
  rendering::BackgroundColor m_ofView;
  QComboBox* m_background;
  QCheckBox* m_date;
  QCheckBox* m_identity;
};

/// `petrous render --width-mm`.
class PrintDialog : public ShareDialog
{
  Q_OBJECT
public:
  /// `heightToWidth`: of the 3D view, whose shape the picture has; `ofView`: its background.
  PrintDialog(const scene::Case& value, double heightToWidth,
              const rendering::BackgroundColor& ofView, QWidget* parent = nullptr);

  rendering::PrintSize size() const;
  int samples() const; ///< rays a pixel
  rendering::BackgroundColor background() const;

protected:
  QString problem() const override;

private:
  double m_heightToWidth;
  QDoubleSpinBox* m_width;
  QSpinBox* m_dots;
  QSpinBox* m_samples;
  rendering::BackgroundColor m_ofView;
  QComboBox* m_background;
};

/// `petrous render --turntable` and `--along`.
class FilmDialog : public ShareDialog
{
  Q_OBJECT
public:
  FilmDialog(const scene::Case& value, QWidget* parent = nullptr);

  std::string along() const; ///< the structure; empty: once around
  int frames() const;

protected:
  QString problem() const override;
  std::vector<std::filesystem::path> files() const override;

private:
  QComboBox* m_path;
  QSpinBox* m_frames;
};

} // namespace petrous::workstation
