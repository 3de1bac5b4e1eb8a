#pragma once

#include <functional>
#include <vector>

#include <QObject>
#include <QString>

class QAbstractButton;
class QAbstractItemView;
class QAction;
class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QPushButton;
class QSlider;
class QSpinBox;
class QTimer;

namespace petrous::workstation
{

/// Couples widgets to values, one line a widget:
///
///   form->addRow(tr("&Light falloff"),
///                m_bound.add(numberBox("lightFalloff", tip, {0.0, 1000.0, tr(" mm")}),
///                            [this] { return m_settings.light().falloff; },
///                            [this](double mm) { m_settings.setFalloff(mm); }));
///
/// What the user enters is set; then all widgets show the values as they are, also one that was
/// clamped or refused. Showing a value sets nothing, so that no change echoes.
class Bindings : public QObject
{
public:
  template <class T>
  using Get = std::function<T()>;
  template <class T>
  using Set = std::function<void(T)>;

  /// ms without another change after which a value is set: a slider that moves is one change.
  static constexpr int kSettle = 60;

  QDoubleSpinBox* add(QDoubleSpinBox* box, Get<double> get, Set<double> set, int settle = 0);
  QSpinBox* add(QSpinBox* box, Get<int> get, Set<int> set, int settle = 0);
  QSlider* add(QSlider* slider, Get<int> get, Set<int> set, int settle = 0);
  QComboBox* add(QComboBox* box, Get<int> row, Set<int> setRow);
  QAbstractButton* add(QAbstractButton* box, Get<bool> get, Set<bool> set); ///< a check box
  QAction* add(QAction* action, Get<bool> get, Set<bool> set);              ///< checkable

  void refresh(); ///< shows the values, except one that is not set yet; call when one changed
  /// For ranges and lists: whatever that does to the widgets' values is not set.
  void quietly(const std::function<void()>& change);
  void drop(); ///< what is not set yet is not set any more, as it was meant for another case

private:
  struct Bound
  {
    std::function<void()> show;
    QTimer* settle; ///< runs while a value is not set yet; nullptr: set at once
  };
  std::function<void()> couple(std::function<void()> show, const std::function<void()>& apply,
                               int settle = 0);

  std::vector<Bound> m_all;
  bool m_showing = false;
};

/// A number that is entered: range and unit, as it is shown.
struct NumberRange
{
  double least = 0.0;
  double most = 0.0;
  QString unit = {};
  int decimals = 1;
  double step = 0.0;    ///< 0: adaptive
  QString atLeast = {}; ///< in place of the smallest number, such as "none"
  /// A number beyond the range is refused when it is ended; else where it is typed, which in a
  /// range that begins far from 0 may be its first digit.
  bool judgedAtEnd = false;
};

/// Widgets of a panel. `name`: object name, for tests and style. A box takes a number when it is
/// entered as a whole.
QDoubleSpinBox* numberBox(const char* name, const QString& tip, const NumberRange& range);
QSlider* percentSlider(const char* name, const QString& tip);
QComboBox* choiceBox(const char* name, const QString& tip);
QCheckBox* checkBox(const QString& text, const char* name, const QString& tip);
QPushButton* button(const QString& text, const char* name, const QString& tip);

/// Return, Enter and other keys that a cell's editor leaves over stay in it: neither the list nor
/// the window takes them for its own.
void keepKeysInEditors(QAbstractItemView& list);

int percent(double fraction);

} // namespace petrous::workstation
