#include "SendDialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QVBoxLayout>

#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Library/Attachments.h"

namespace petrous::workstation
{

SendDialog::SendDialog(const scene::Case& value, const library::Library& library,
                       const FaceCheck& faces, const std::vector<network::Node>& nodes,
                       QWidget* parent)
  : QDialog(parent)
  , m_value(value)
  , m_library(library)
  , m_nodes(nodes)
  , m_node(new QComboBox)
  , m_ct(new QCheckBox(value.ct.modality == scene::Modality::Mr
                           ? tr("The &MR of the case, as a series")
                           : tr("&CT, as a series")))
  , m_mr(new QCheckBox(tr("M&R, a series each")))
  , m_labels(new QCheckBox(tr("Str&uctures, as segmentations (SEG)")))
  , m_scene(new QCheckBox(tr("The &whole scene, to be received as it is (Raw Data)")))
  , m_note(new QCheckBox(tr("with its &note")))
  , m_videos(new QCheckBox(tr("with its &videos, which may show or name the patient")))
  , m_documents(new QCheckBox(tr("with its PD&Fs, which may name the patient")))
  , m_maskFace(new QCheckBox(tr("Put a&ir in place of the face")))
  , m_faces(faces)
  , m_report(new QPlainTextEdit)
{
  setObjectName("sendCase");
  setWindowTitle(tr("Send “%1”").arg(words(value.name)));
  m_node->setObjectName("sendNode");
  for (const network::Node& node : nodes)
    m_node->addItem(QString("%1 (%2 %3 %4:%5%6)")
                        .arg(words(node.name), words(node.aeTitle), tr("at"), words(node.host))
                        .arg(node.port)
                        .arg(node.tls ? ", TLS" : ""));
  m_ct->setObjectName("sendCt");
  m_mr->setObjectName("sendMr");
  m_labels->setObjectName("sendLabels");
  m_scene->setObjectName("sendScene");
  m_note->setObjectName("sendNote");
  m_videos->setObjectName("sendVideos");
  m_documents->setObjectName("sendDocuments");
  m_maskFace->setObjectName("sendMaskFace");
  m_maskFace->setToolTip(tr("In front of a plane about 50 mm behind the tip of the nose. What is "
                            "segmented or drilled and the temporal bones stay; the case here does "
                            "not change"));
  m_maskFace->setEnabled(m_faces.mayHave());
  m_report->setObjectName("sendReport");
  m_report->setAccessibleName(tr("What is sent of the patient"));
  m_report->setReadOnly(true);
  m_report->setMinimumHeight(200);
  const bool hasMr = !value.mr.empty();
  const bool hasLabels = !value.labels.empty();
  m_ct->setChecked(true);
  m_mr->setEnabled(hasMr);
  m_mr->setChecked(hasMr);
  m_labels->setEnabled(hasLabels);
  m_labels->setChecked(hasLabels);
  m_scene->setChecked(true);
  m_scene->setToolTip(tr("A PACS keeps it without being able to show it; Library > Receive brings "
                         "back the very same case"));

  auto* form = new QFormLayout;
  form->addRow(tr("&To:"), m_node);
  form->addRow(tr("What:"), m_ct);
  for (QCheckBox* box : {m_mr, m_labels, m_scene, m_note, m_videos, m_documents, m_maskFace})
    form->addRow({}, box);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  m_send = buttons->addButton(tr("&Send"), QDialogButtonBox::AcceptRole);
  m_send->setObjectName("primary");
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  for (QCheckBox* box : {m_ct, m_mr, m_labels, m_scene, m_note, m_videos, m_documents, m_maskFace})
    connect(box, &QCheckBox::toggled, this, &SendDialog::update);
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(form);
  layout->addWidget(new QLabel(tr("What leaves this computer:")));
  layout->addWidget(m_report, 1);
  layout->addWidget(buttons);
  resize(640, 520);
  update();
}

presenters::SendParts SendDialog::parts() const
{
  presenters::SendParts parts;
  parts.primary = m_ct->isChecked();
  parts.mr = m_mr->isChecked();
  parts.labels = m_labels->isChecked();
  parts.scene = m_scene->isChecked();
  parts.note = m_note->isEnabled() && m_note->isChecked();
  parts.videos = m_videos->isEnabled() && m_videos->isChecked();
  parts.documents = m_documents->isEnabled() && m_documents->isChecked();
  parts.mask.face = m_maskFace->isEnabled() && m_maskFace->isChecked();
  parts.mask.found = m_faces.found;
  return parts;
}

std::vector<scene::ImageWithFace> SendDialog::facesSent(const presenters::SendParts& what) const
{
  std::vector<scene::ImageWithFace> sent;
  for (const scene::ImageWithFace& image : m_faces.images)
    if (presenters::isSent(m_value, what, image.mr))
      sent.push_back(image);
  return sent;
}

QStringList SendDialog::facesLeft() const
{
  const presenters::SendParts what = parts();
  if (what.mask.face)
    return {};
  if (m_faces.isKnown)
    return warningsOf(facesSent(what));
  const bool sendsImages = presenters::isSent(m_value, what, "") ||
                           std::any_of(m_value.mr.begin(), m_value.mr.end(),
                                       [&](const scene::ImagePart& mr)
                                       { return presenters::isSent(m_value, what, mr.name); });
  return sendsImages ? QStringList{textOf(m_faces)} : QStringList();
}

network::Node SendDialog::node() const
{
  return m_nodes.at(static_cast<std::size_t>(m_node->currentIndex()));
}

void SendDialog::update()
{
  m_note->setEnabled(m_scene->isChecked() && !m_value.description.note.empty());
  using Kind = scene::Attachment::Kind;
  m_videos->setEnabled(m_scene->isChecked() && library::hasAttachment(m_value, Kind::Video));
  m_documents->setEnabled(m_scene->isChecked() && library::hasAttachment(m_value, Kind::Document));
  const presenters::SendParts what = parts();
  const bool any = what.ct || what.mr || what.labels || what.scene;
  m_send->setEnabled(any);
  if (!any)
    return m_report->setPlainText(tr("Nothing is chosen."));
  const std::vector<scene::ImageWithFace> images = facesSent(what);
  const auto* faces = m_faces.isKnown ? &images : nullptr;
  QString text = phrase(presenters::identityReport(m_value, what, faces, &m_library).text());
  for (const scene::ImageWithFace& image : images)
    if (what.mask.face && !image.fault.empty())
      text += '\n' + phrase(image.fault);
  if (!m_faces.isKnown)
    text += '\n' + textOf(m_faces);
  m_report->setPlainText(text);
}

} // namespace petrous::workstation
