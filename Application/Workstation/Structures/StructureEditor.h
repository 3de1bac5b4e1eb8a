#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <QWidget>

#include "Bind.h"
#include "petrous/Presenters/WorkstationModel.h"

class QCheckBox;
class QComboBox;
class QGridLayout;
class QLabel;
class QPushButton;

namespace petrous::appearance
{
struct StructureProperty;
}

namespace petrous::workstation
{

/// The properties of the structures that are selected in the list, also of several at once. Where
/// theirs differ, it says so, and what is entered becomes that of all.
class StructureEditor : public QWidget
{
  Q_OBJECT
public:
  explicit StructureEditor(presenters::WorkstationModel& model, QWidget* parent = nullptr);

  /// `title`: what they are, as it is shown.
  void setParts(std::vector<std::string> parts, const QString& title);
  const std::vector<std::string>& parts() const noexcept { return m_parts; }
  void refresh();
  void materialsChanged(); ///< the library has others
  void takeFocus();        ///< by key

  /// Lets the user choose their colour at this point of the screen, with a live preview.
  void chooseColor(const std::vector<std::string>& parts, const QPoint& global);

signals:
  void left(); ///< by Escape

protected:
  void keyPressEvent(QKeyEvent* event) override;
  void hideEvent(QHideEvent* event) override;

private:
  using Property = appearance::StructureProperty;
  struct Number
  {
    const Property* property;
    QDoubleSpinBox* box;
    QString tip = {};
  };
  struct Flag
  {
    const Property* property;
    QCheckBox* box;
    QString tip = {};
  };
  struct Text
  {
    const Property* property;
    QComboBox* box;
  };
  QDoubleSpinBox* addNumber(const char* key, double step);
  QCheckBox* addFlag(const char* key);
  void addOpacity(QGridLayout& grid, int row);
  QComboBox* addPresets();
  QComboBox* addMaterials();
  void offerMaterials();
  QPushButton* addSoftTissues();
  void change(const std::function<void(const std::string&, appearance::StructureAppearance&)>& to,
              const Property& property);
  std::vector<const appearance::StructureAppearance*> looks(const Property& property) const;
  bool differ(const Property& property) const;
  /// The selected parts of which the property changes something.
  std::vector<std::string> partsWith(const Property& property) const;
  /// The tip, and why the property changes nothing of those that are selected.
  QString withIdle(const QString& tip, const Property& property) const;

  presenters::WorkstationModel& m_model;
  std::vector<std::string> m_parts;
  QLabel* m_title;
  QPushButton* m_color;
  QSlider* m_opacity;
  std::unique_ptr<presenters::EditHistory::Hold> m_opacityHold; ///< while it is dragged
  QComboBox* m_materials;
  QPushButton* m_softTissues; ///< the stiffness from published moduli
  std::vector<Number> m_numbers;
  std::vector<Flag> m_flags;
  std::vector<Text> m_texts;
  Bindings m_bound;
};

} // namespace petrous::workstation
