#include "Passphrase.h"

#include <QLineEdit>

#include "petrous/Presenters/FolderIdentity.h"

namespace petrous::workstation
{

QLineEdit* passphraseLine(const char* name)
{
  auto* line = new QLineEdit;
  line->setObjectName(name);
  line->setEchoMode(QLineEdit::Password);
  line->setInputMethodHints(Qt::ImhSensitiveData | Qt::ImhNoPredictiveText | Qt::ImhHiddenText);
  return line;
}

// Qt's copy of the text is shared with the widget: overwritten in place where it is the only one.
void clearPassphrase(QLineEdit& line)
{
  line.setText(QString(line.text().size(), QChar('0')));
  line.clear();
}

std::shared_ptr<const std::string> takePassphrase(QLineEdit& line)
{
  QByteArray text = line.text().toUtf8();
  std::shared_ptr<const std::string> secret(
      new std::string(text.constData(), static_cast<std::size_t>(text.size())),
      [](const std::string* one)
      {
        presenters::wipe(const_cast<std::string&>(*one));
        delete one;
      });
  text.fill('0');
  clearPassphrase(line);
  return secret;
}

} // namespace petrous::workstation
