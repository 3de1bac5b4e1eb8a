#include "Bind.h"

#include <cmath>
#include <utility>

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QKeyEvent>
#include <QPushButton>
#include <QRegularExpression>
#include <QScopedValueRollback>
#include <QSlider>
#include <QTimer>

namespace petrous::workstation
{

// Returns what to do when the user has changed the widget.
std::function<void()> Bindings::couple(std::function<void()> show,
                                       const std::function<void()>& apply, int settle)
{
  QTimer* timer = settle > 0 ? new QTimer(this) : nullptr;
  m_all.push_back({std::move(show), timer});
  const auto enter = [this, apply]
  {
    apply();
    refresh();
  };
  if (timer)
  {
    timer->setSingleShot(true);
    timer->setInterval(settle);
    connect(timer, &QTimer::timeout, this, enter);
  }
  return [this, timer, enter]
  {
    if (m_showing)
      return;
    if (!timer)
      return enter();
    timer->start();
    refresh(); // those that follow this one
  };
}

QDoubleSpinBox* Bindings::add(QDoubleSpinBox* box, Get<double> get, Set<double> set, int settle)
{
  connect(box, qOverload<double>(&QDoubleSpinBox::valueChanged), this,
          couple([box, get] { box->setValue(get()); }, [box, set] { set(box->value()); }, settle));
  return box;
}

QSpinBox* Bindings::add(QSpinBox* box, Get<int> get, Set<int> set, int settle)
{
  connect(box, qOverload<int>(&QSpinBox::valueChanged), this,
          couple([box, get] { box->setValue(get()); }, [box, set] { set(box->value()); }, settle));
  return box;
}

QSlider* Bindings::add(QSlider* slider, Get<int> get, Set<int> set, int settle)
{
  connect(slider, &QSlider::valueChanged, this,
          couple([slider, get] { slider->setValue(get()); },
                 [slider, set] { set(slider->value()); }, settle));
  return slider;
}

QComboBox* Bindings::add(QComboBox* box, Get<int> row, Set<int> setRow)
{
  connect(box, qOverload<int>(&QComboBox::currentIndexChanged), this,
          couple([box, row] { box->setCurrentIndex(row()); },
                 [box, setRow] { setRow(box->currentIndex()); }));
  return box;
}

QAbstractButton* Bindings::add(QAbstractButton* box, Get<bool> get, Set<bool> set)
{
  connect(box, &QAbstractButton::toggled, this,
          couple([box, get] { box->setChecked(get()); }, [box, set] { set(box->isChecked()); }));
  return box;
}

QAction* Bindings::add(QAction* action, Get<bool> get, Set<bool> set)
{
  connect(action, &QAction::toggled, this,
          couple([action, get] { action->setChecked(get()); },
                 [action, set] { set(action->isChecked()); }));
  return action;
}

void Bindings::refresh()
{
  quietly(
      [this]
      {
        for (const Bound& one : m_all)
          if (!one.settle || !one.settle->isActive())
            one.show();
      });
}

void Bindings::quietly(const std::function<void()>& change)
{
  const QScopedValueRollback<bool> showing(m_showing, true);
  change();
}

void Bindings::drop()
{
  for (const Bound& one : m_all)
    if (one.settle)
      one.settle->stop();
}

namespace
{

// Shows no -0.0.
class NumberBox : public QDoubleSpinBox
{
public:
  explicit NumberBox(bool judgedAtEnd)
    : m_judgedAtEnd(judgedAtEnd)
  {
  }

  QValidator::State validate(QString& text, int& at) const override
  {
    const QValidator::State state = QDoubleSpinBox::validate(text, at);
    if (state != QValidator::Invalid || !m_judgedAtEnd)
      return state;
    const QString number =
        (text.endsWith(suffix()) ? text.chopped(suffix().size()) : text).trimmed();
    const QRegularExpression form(QRegularExpression::anchoredPattern(
        QString("[-+]?\\d*(%1\\d{0,%2})?")
            .arg(QRegularExpression::escape(QString(locale().decimalPoint())))
            .arg(decimals())));
    return form.match(number).hasMatch() ? QValidator::Intermediate : QValidator::Invalid;
  }

  QString textFromValue(double value) const override
  {
    const bool isZero = std::abs(value) < 0.5 * std::pow(10.0, -decimals());
    return QDoubleSpinBox::textFromValue(isZero ? 0.0 : value);
  }

private:
  bool m_judgedAtEnd;
};

} // namespace

QDoubleSpinBox* numberBox(const char* name, const QString& tip, const NumberRange& range)
{
  QDoubleSpinBox* box = new NumberBox(range.judgedAtEnd);
  box->setObjectName(name);
  box->setToolTip(tip);
  box->setDecimals(range.decimals);
  box->setRange(range.least, range.most);
  box->setSuffix(range.unit);
  box->setSpecialValueText(range.atLeast);
  if (range.step > 0.0)
    box->setSingleStep(range.step);
  else
    box->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  box->setKeyboardTracking(false);
  return box;
}

QSlider* percentSlider(const char* name, const QString& tip)
{
  auto* slider = new QSlider(Qt::Horizontal);
  slider->setObjectName(name);
  slider->setToolTip(tip);
  slider->setRange(0, 100);
  slider->setPageStep(10);
  return slider;
}

QComboBox* choiceBox(const char* name, const QString& tip)
{
  auto* box = new QComboBox;
  box->setObjectName(name);
  box->setToolTip(tip);
  return box;
}

QCheckBox* checkBox(const QString& text, const char* name, const QString& tip)
{
  auto* box = new QCheckBox(text);
  box->setObjectName(name);
  box->setToolTip(tip);
  return box;
}

QPushButton* button(const QString& text, const char* name, const QString& tip)
{
  auto* result = new QPushButton(text);
  result->setObjectName(name);
  result->setToolTip(tip);
  return result;
}

namespace
{

// What an editor leaves over comes to the viewport, its parent, next; the list's own keys do not.
class EditorKeys : public QObject
{
public:
  explicit EditorKeys(QAbstractItemView& list)
    : QObject(&list)
  {
    list.viewport()->installEventFilter(this);
  }

  bool eventFilter(QObject* watched, QEvent* event) override
  {
    const bool isPress = event->type() == QEvent::KeyPress;
    if (!isPress && event->type() != QEvent::ShortcutOverride)
      return false;
    const auto* viewport = static_cast<const QWidget*>(watched);
    const int key = static_cast<QKeyEvent*>(event)->key();
    const bool isTaken = isPress || key == Qt::Key_Return || key == Qt::Key_Enter ||
                         key == Qt::Key_Escape || key == Qt::Key_Delete;
    if (!isTaken || !viewport->focusWidget() || viewport->focusWidget() == viewport)
      return false;
    event->accept();
    return true;
  }
};

} // namespace

void keepKeysInEditors(QAbstractItemView& list)
{
  new EditorKeys(list);
}

int percent(double fraction)
{
  return static_cast<int>(std::lround(100.0 * fraction));
}

} // namespace petrous::workstation
