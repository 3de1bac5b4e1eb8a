#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <QDialog>

class QCheckBox;
class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;

namespace petrous::workstation
{

/// Names of parts that come to a case, and in whose patient space structures were drawn.
class AddPartsDialog : public QDialog
{
  Q_OBJECT
public:
  struct Part
  {
    QString what;            ///< "MR “t2.nii”"
    std::string name;        ///< proposed; may be empty
    bool isNamed = true;     ///< by the user; else the file names its structures
    bool isPlaced = false;   ///< structures and meshes: in the space of the CT or an MR
    std::size_t count = 0;   ///< structures of the file; 0: not known
    std::size_t unnamed = 0; ///< those of them without a name: a table can name them
    QString folder;          ///< where such a table may be
    std::size_t objects = 0; ///< of a mesh file; several can become a structure each
  };
  struct Answer
  {
    std::string name;                      ///< empty: the file's own
    std::string drawnOn;                   ///< PartSource::drawnOn
    std::filesystem::path labelNames = {}; ///< likewise
    bool isPerObject = false;              ///< likewise; the name may be empty
  };

  /// What exec() returns where the parts are not wanted, and others are.
  static constexpr int kSkipped = 2;

  /// `title` asks, `accept` is the button's text, `skip` that of one for kSkipped (empty: there is
  /// none); `taken` are names of other parts, `mr` those of
  /// MRs on which structures may have been drawn, `primary` "CT" or "MR".
  AddPartsDialog(const QString& title, const QString& more, const QString& accept,
                 const std::vector<Part>& parts, std::vector<std::string> taken,
                 const std::vector<std::string>& mr, const QString& primary,
                 QWidget* parent = nullptr, const QString& skip = {});

  std::vector<Answer> answers() const; ///< for each part

private:
  void check();
  QWidget* tableChoice(std::size_t row, const Part& part);
  QCheckBox* objectsChoice(QLineEdit* name, const Part& part);

  struct Row
  {
    QLineEdit* name = nullptr;      ///< nullptr: not named
    QComboBox* place = nullptr;     ///< nullptr: not placed
    QCheckBox* perObject = nullptr; ///< nullptr: not of several objects
    std::filesystem::path table = {};
  };
  std::vector<Row> m_rows;
  std::vector<std::string> m_taken;
  QLabel* m_advice;
  QPushButton* m_accept;
};

} // namespace petrous::workstation
