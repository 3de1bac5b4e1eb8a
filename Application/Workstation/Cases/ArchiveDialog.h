#pragma once

#include <filesystem>

#include <QDialog>
#include <QStringList>

#include "FaceCheck.h"
#include "petrous/Library/Archive.h"
#include "petrous/Scene/Case.h"

class QCheckBox;
class QLabel;
class QPlainTextEdit;
class QPushButton;

namespace petrous::workstation
{

class PathRow;

/// The file of an archive (`petrous archive`), what of the case goes into it, and what may identify
/// the patient. A file that is there is replaced only with consent.
class ArchiveDialog : public QDialog
{
  Q_OBJECT
public:
  /// The case must outlive the dialog.
  ArchiveDialog(const scene::Case& value, const library::Library& library, FaceCheck faces,
                QWidget* parent = nullptr);

  std::filesystem::path file() const; ///< with its ending
  library::ArchiveOptions options() const;
  scene::ImageMask mask() const;
  /// MRs whose face cannot be masked, where faces are; they are left out.
  std::vector<std::string> withoutMrs() const;
  /// That faces go along unmasked, a sentence each; empty: none does, as far as is known.
  QStringList facesLeft() const;

  void accept() override;

private:
  QStringList findWhatCannotBeMasked();
  void update();
  bool masks() const;
  bool mayLeaveFaces();

  const scene::Case& m_value;
  FaceCheck m_faces;
  std::vector<std::string> m_notMaskable; ///< MRs
  bool m_canMask = false; ///< there may be faces, and what cannot be masked can be left out
  library::Library m_library;
  PathRow* m_file;
  QCheckBox* m_plan;
  QCheckBox* m_note;
  QCheckBox* m_videos;
  QCheckBox* m_documents;
  QCheckBox* m_date;
  QCheckBox* m_maskFace;
  QPlainTextEdit* m_report;
  QLabel* m_advice;
  QPushButton* m_accept;
  bool m_noteIsPlain = false; ///< it is there, and nothing in it looks like the patient
  bool m_noteIsChosen = false;
};

} // namespace petrous::workstation
