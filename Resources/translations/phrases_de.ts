<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>Presenters</name>
    <message>
        <source>preset '%1' has values of an MR, which mean nothing in the %~2; choose another image to be read first</source>
        <translation>die Vorgabe „%1“ hat Werte eines MR, die im %~2 nichts bedeuten; wählen Sie zuerst ein anderes Bild, das gelesen wird</translation>
    </message>
    <message>
        <source>preset '%1' has values of an MR, which mean nothing in the MR '%2'; choose another image to be read first</source>
        <translation>die Vorgabe „%1“ hat Werte eines MR, die im MR „%2“ nichts bedeuten; wählen Sie zuerst ein anderes Bild, das gelesen wird</translation>
    </message>
    <message>
        <source>preset '%1' has values of a CT, which mean nothing in the %~2; choose another image to be read first</source>
        <translation>die Vorgabe „%1“ hat Werte eines CT, die im %~2 nichts bedeuten; wählen Sie zuerst ein anderes Bild, das gelesen wird</translation>
    </message>
    <message>
        <source>preset '%1' has values of a CT, which mean nothing in the MR '%2'; choose another image to be read first</source>
        <translation>die Vorgabe „%1“ hat Werte eines CT, die im MR „%2“ nichts bedeuten; wählen Sie zuerst ein anderes Bild, das gelesen wird</translation>
    </message>
    <message>
        <source>A lumen tints the bone around it and reads the %~1</source>
        <translation>Ein Hohlraum tönt den Knochen um ihn und liest das %~1</translation>
    </message>
    <message>
        <source>Soft tissue is not drawn: %~1</source>
        <translation>Weichgewebe wird nicht dargestellt: %~1</translation>
    </message>
    <message>
        <source>'%1' is not registered: drawn in one colour until it is</source>
        <translation>„%1“ ist nicht registriert: bis dahin einfarbig dargestellt</translation>
    </message>
    <message>
        <source>Presets are made for CT: drawn in one colour until it has points in values of '%1'</source>
        <translation>Vorgaben sind für CT gemacht: einfarbig dargestellt, bis Punkte in Werten von „%1“ gesetzt sind</translation>
    </message>
    <message>
        <source>the case has no MR '%1'</source>
        <translation>der Fall hat kein MR „%1“</translation>
    </message>
    <message>
        <source>preset '%1' is that of a lumen and cannot be the look of bone</source>
        <translation>die Vorgabe „%1“ gehört zu einem Hohlraum und kann nicht die Darstellung des Knochens sein</translation>
    </message>
    <message>
        <source>preset '%1' is that of a lumen and cannot be the look of soft tissue</source>
        <translation>die Vorgabe „%1“ gehört zu einem Hohlraum und kann nicht die Darstellung des Weichgewebes sein</translation>
    </message>
    <message>
        <source>the image has no values there</source>
        <translation>das Bild hat dort keine Werte</translation>
    </message>
    <message>
        <source>'%1' is a mesh and reads no image</source>
        <translation>„%1“ ist ein Netz und liest kein Bild</translation>
    </message>
    <message>
        <source>'%1' is a lumen and reads the bone around it</source>
        <translation>„%1“ ist ein Hohlraum und liest den Knochen um ihn</translation>
    </message>
    <message>
        <source>soft tissue of a CT is not fitted; apply a preset, whose values follow the image's scale</source>
        <translation>Weichgewebe eines CT wird nicht angepasst; eine Vorgabe wählen, deren Werte der Skala des Bildes folgen</translation>
    </message>
    <message>
        <source>'%1' has no voxel in the image that it reads</source>
        <translation>„%1“ hat kein Voxel in dem Bild, das gelesen wird</translation>
    </message>
    <message>
        <source>counting intensities</source>
        <translation>Intensitäten werden gezählt</translation>
    </message>
    <message>
        <source>named so and not as its file, whose name may be a patient's; NAME=FILE gives another name</source>
        <translation>so benannt und nicht wie die Datei, deren Name der eines Patienten sein kann; F2 in der Liste gibt einen anderen Namen</translation>
    </message>
    <message>
        <source>With --repair it is resampled to a straight volume.</source>
        <translation>Allein geöffnet, lässt sie sich reparieren.</translation>
    </message>
    <message>
        <source>Give a series that 'petrous scan' finds ok.</source>
        <translation>Wählen Sie eine Serie, die als in Ordnung gilt.</translation>
    </message>
    <message>
        <source>patient ID and patient name</source>
        <translation>Patienten-ID und Patientenname</translation>
    </message>
    <message>
        <source>patient ID and date of birth</source>
        <translation>Patienten-ID und Geburtsdatum</translation>
    </message>
    <message>
        <source>patient ID</source>
        <translation>Patienten-ID</translation>
    </message>
    <message>
        <source>patient name</source>
        <translation>Patientenname</translation>
    </message>
    <message>
        <source>date of birth</source>
        <translation>Geburtsdatum</translation>
    </message>
    <message>
        <source>Whether it is of the patient of the case's images is not known: the library's salt, with which their patients' hashes were made, was lost; look whether it is</source>
        <translation>Ob es vom Patienten der Bilder des Falls ist, ist nicht bekannt: Das Salt der Bibliothek, mit dem die Hashes ihrer Patienten gebildet wurden, ging verloren; sehen Sie nach, ob es so ist</translation>
    </message>
    <message>
        <source>%1: its CT cannot be used Only an MR can; name its series (--series, 'petrous scan' lists them) for a case of the MR alone</source>
        <translation>%1: Das CT darin ist nicht verwendbar; nur ein MR ist es. Wählen Sie dessen Serie für einen Fall allein mit dem MR</translation>
    </message>
    <message>
        <source>%1: its CT cannot be used: %~2 Only an MR can; name its series (--series, 'petrous scan' lists them) for a case of the MR alone</source>
        <translation>%1: Das CT darin ist nicht verwendbar: %~2 Nur ein MR ist es; wählen Sie dessen Serie für einen Fall allein mit dem MR</translation>
    </message>
    <message>
        <source>%#1 slices</source>
        <translation>%#1 Schichten</translation>
    </message>
    <message>
        <source>The folder has another</source>
        <translation>Der Ordner hat eine weitere</translation>
    </message>
    <message>
        <source>The folder has other</source>
        <translation>Der Ordner hat weitere</translation>
    </message>
    <message>
        <source>%~1, which was not taken; 'petrous scan' lists them, --series takes one.</source>
        <translation>%~1, nicht genommen.</translation>
    </message>
    <message>
        <source>unknown</source>
        <translation>unbekannt</translation>
    </message>
    <message>
        <source>The file says that it is neither a CT nor an MR, but of modality %~1.</source>
        <translation>Laut Datei weder CT noch MR, sondern Modalität %~1.</translation>
    </message>
    <message>
        <source>The file says that its values are of an unspecified type (US), and not that they are Hounsfield units.</source>
        <translation>Die Datei nennt für ihre Werte eine unbestimmte Art (US) und nicht, dass sie Hounsfield-Einheiten sind.</translation>
    </message>
    <message>
        <source>The file says that its values are no Hounsfield units, but of the type %~1.</source>
        <translation>Laut Datei sind die Werte keine Hounsfield-Einheiten, sondern vom Typ %~1.</translation>
    </message>
    <message>
        <source>The index of the disc (DICOMDIR) lists %#1 file of another series that is not there: what they showed is missing from this copy of the disc.</source>
        <translation>Das Inhaltsverzeichnis des Datenträgers (DICOMDIR) führt %#1 Datei einer anderen Serie auf, die nicht da ist: Was sie zeigte, fehlt auf dieser Kopie.</translation>
    </message>
    <message>
        <source>The index of the disc (DICOMDIR) lists %#1 files of other series that are not there: what they showed is missing from this copy of the disc.</source>
        <translation>Das Inhaltsverzeichnis des Datenträgers (DICOMDIR) führt %#1 Dateien anderer Serien auf, die nicht da sind: Was sie zeigten, fehlt auf dieser Kopie.</translation>
    </message>
    <message>
        <source>Of what lies beside its slices, something was left out in %#1 place; 'petrous scan' says what.</source>
        <translation>Neben den Schichten wurde an %#1 Stelle etwas ausgelassen.</translation>
    </message>
    <message>
        <source>Of what lies beside its slices, something was left out in %#1 places; 'petrous scan' says what.</source>
        <translation>Neben den Schichten wurde an %#1 Stellen etwas ausgelassen.</translation>
    </message>
    <message>
        <source>%1: every voxel that is no padding has the value %#2; an image of one single value shows nothing</source>
        <translation>%1: Jedes Voxel außerhalb der Auffüllung hat den Wert %#2; ein Bild aus einem einzigen Wert zeigt nichts</translation>
    </message>
    <message>
        <source>The image has only %#1 slices, which cover %#2 mm; look whether all that is needed is in it.</source>
        <translation>Das Bild hat nur %#1 Schichten, die über %#2 mm reichen; sehen Sie nach, ob alles Benötigte darin ist.</translation>
    </message>
    <message>
        <source>Its values go from %#1 to %#2, beyond those of any CT (-10000 to 100000): voxels are damaged, or the slope that the file states is wrong.</source>
        <translation>Seine Werte reichen von %#1 bis %#2, weiter als die jedes CT (-10000 bis 100000): Voxel sind beschädigt, oder die Steigung, die die Datei angibt, ist falsch.</translation>
    </message>
    <message>
        <source>The file says that it is an MR; it is taken for an MR, as asked.</source>
        <translation>Laut Datei ein MR; wie gewünscht als MR genommen.</translation>
    </message>
    <message>
        <source>The file says that it is an MR; it is taken for a CT, as asked.</source>
        <translation>Laut Datei ein MR; wie gewünscht als CT genommen.</translation>
    </message>
    <message>
        <source>The file says that it is a CT; it is taken for an MR, as asked.</source>
        <translation>Laut Datei ein CT; wie gewünscht als MR genommen.</translation>
    </message>
    <message>
        <source>The file says that it is a CT; it is taken for a CT, as asked.</source>
        <translation>Laut Datei ein CT; wie gewünscht als CT genommen.</translation>
    </message>
    <message>
        <source>An MR shows no bone: its intensities are not Hounsfield units, and bone is as dark as air in it. The surface is where tissue begins, put at %#1 by the image's histogram; what is drilled is this tissue, not bone. 'petrous appearance --iso' moves the surface.</source>
        <translation>Ein MR zeigt keinen Knochen: Seine Intensitäten sind keine Hounsfield-Einheiten, und Knochen ist darin so dunkel wie Luft. Die Oberfläche liegt, wo Gewebe beginnt, nach dem Histogramm des Bildes bei %#1; gebohrt wird dieses Gewebe, nicht Knochen. Die Oberflächenschwelle (F9) verschiebt die Oberfläche.</translation>
    </message>
    <message>
        <source>%~1 It is shown as it is: nothing in it is known to be bone, and the surface is put at %#2 by the image's histogram; 'petrous appearance --iso' moves it. Build the case with --modality CT if it is a CT in Hounsfield units all the same.</source>
        <translation>%~1 Gezeigt wird es, wie es ist: Nichts darin ist als Knochen bekannt, und die Oberfläche liegt nach dem Histogramm des Bildes bei %#2; die Oberflächenschwelle (F9) verschiebt sie. Ist es doch ein CT in Hounsfield-Einheiten, öffnen Sie es noch einmal und geben Sie es auf die Frage an.</translation>
    </message>
    <message>
        <source>%~1 Air and soft tissue have in it the values of a CT, so the surface of bone is put at %#2, but no value is called HU. Build the case with --modality CT if it is a CT in Hounsfield units.</source>
        <translation>%~1 Luft und Weichteile haben darin die Werte eines CT, deshalb liegt die Knochenoberfläche bei %#2, aber kein Wert wird HU genannt. Ist es ein CT in Hounsfield-Einheiten, öffnen Sie es noch einmal und geben Sie es auf die Frage an.</translation>
    </message>
    <message>
        <source>Its histogram shows neither air nor soft tissue as a CT has them, as that of a small part of one. The file states that its values are Hounsfield units, and is of a helical CT or was exported by Petrous, so the surface of bone is put at 300 HU; 'petrous appearance --iso' moves it.</source>
        <translation>Sein Histogramm zeigt weder Luft noch Weichteile, wie ein CT sie hat, wie das eines kleinen Teils eines CT. Die Datei sagt, dass ihre Werte Hounsfield-Einheiten sind, und stammt von einem Spiral-CT oder wurde von Petrous exportiert, also liegt die Oberfläche des Knochens bei 300 HU; die Knochenschwelle (F9) verschiebt sie.</translation>
    </message>
    <message>
        <source>Its histogram has no peaks of air and soft tissue, as that of a small part of a CT. It was judged by its values: soft tissue is near 40, and nothing below air, so they are taken for Hounsfield units, and the surface of bone is put at 300 HU; 'petrous appearance --iso' moves it.</source>
        <translation>Sein Histogramm hat keine Gipfel von Luft und Weichteilen, wie das eines kleinen Teils eines CT. Beurteilt wurde es nach seinen Werten: Weichteile liegen nahe 40, und nichts unter Luft, also gelten sie als Hounsfield-Einheiten, und die Oberfläche des Knochens liegt bei 300 HU; die Knochenschwelle (F9) verschiebt sie.</translation>
    </message>
    <message>
        <source>The file does not say whether it is a CT or an MR; it is taken for a CT with units of its own, such as cone beam. Build the case with --modality MR if it is an MR, --modality CT if it is not.</source>
        <translation>Die Datei sagt nicht, ob sie ein CT oder ein MR ist; sie wird als CT mit eigenen Einheiten genommen, etwa eine DVT. Ist sie ein MR, öffnen Sie sie noch einmal und geben Sie es auf die Frage an.</translation>
    </message>
    <message>
        <source>The intensities are not Hounsfield units: the surface of bone is put at %#1, and dense bone taken for %#2, by the image's histogram; 'petrous appearance --iso' moves the surface. Of a small part of a CT this may be wrong: where its values are Hounsfield units all the same, bone begins at 300 ('petrous appearance --iso 300').</source>
        <translation>Die Intensitäten sind keine Hounsfield-Einheiten: Die Oberfläche des Knochens liegt nach dem Histogramm des Bildes bei %#1, dichter Knochen bei %#2; die Knochenschwelle (F9) verschiebt die Oberfläche. Bei einem kleinen Teil eines CT kann das falsch sein: Sind seine Werte doch Hounsfield-Einheiten, beginnt Knochen bei 300 (Knochenschwelle 300).</translation>
    </message>
    <message>
        <source>The intensities are not Hounsfield units: the surface of bone is put at %#1, and dense bone taken for %#2, by the image's histogram; 'petrous appearance --iso' moves the surface.</source>
        <translation>Die Intensitäten sind keine Hounsfield-Einheiten: Die Oberfläche des Knochens liegt nach dem Histogramm des Bildes bei %#1, dichter Knochen bei %#2; die Knochenschwelle (F9) verschiebt die Oberfläche.</translation>
    </message>
    <message>
        <source>%1: %~2 '%3' is in the case already; give it another name with NAME=FILE</source>
        <translation>%1: %~2 „%3“ ist schon im Fall; geben Sie einen anderen Namen</translation>
    </message>
    <message>
        <source>%1: %~2 '%3' is in the case already; give it another name than '%4', which reads the same, with NAME=FILE</source>
        <translation>%1: %~2 „%3“ ist schon im Fall; geben Sie einen anderen Namen als „%4“, der gleich aussieht</translation>
    </message>
    <message>
        <source>'%1' is called '%2' here, as the case has a part of this name already</source>
        <translation>„%1“ heißt hier „%2“, da der Fall schon einen Teil dieses Namens hat</translation>
    </message>
    <message>
        <source>has the grid of the MR '%1', which was added later: it was taken to be drawn on that MR, and lies where its registration puts it, no longer in the CT's space; FILE@ct keeps it there</source>
        <translation>hat das Gitter des später hinzugefügten MR „%1“: gilt als auf diesem MR gezeichnet und liegt, wo dessen Registrierung es hinlegt, nicht mehr im Raum des CT; beim Hinzufügen „auf dem CT“ zu wählen belässt es dort</translation>
    </message>
    <message>
        <source>Only a region of it was read, as asked; labels on the grid of the whole image lie on it only as FILE@%1.</source>
        <translation>Wie gewünscht wurde nur ein Bereich gelesen; kommen Labels auf dem Gitter des ganzen Bildes hinzu, wählen Sie „%1“ als das Bild, auf dem sie gezeichnet wurden.</translation>
    </message>
    <message>
        <source>Its files state another patient's ID, name or date of birth than those of the case's other images; it was added as asked.</source>
        <translation>Die Dateien nennen eine andere Patienten-ID, einen anderen Namen oder ein anderes Geburtsdatum als die übrigen Bilder des Falls; wie gewünscht hinzugefügt.</translation>
    </message>
    <message>
        <source>The file says that it is a CT; it was added as an MR, as asked. If it is the patient's CT, begin a case with it (petrous new --ct).</source>
        <translation>Laut Datei ein CT; wie gewünscht als MR hinzugefügt. Ist es das CT des Patienten, beginnen Sie einen Fall damit (Datei &gt; DICOM öffnen).</translation>
    </message>
    <message>
        <source>It looks like a label map and not like an image: neighbouring voxels have the same whole numbers. If it is one, remove it and add it as labels.</source>
        <translation>Sie sieht wie eine Segmentierung und nicht wie ein Bild aus: Benachbarte Voxel haben dieselben ganzen Zahlen. Wenn sie eine ist, entfernen Sie sie und fügen Sie sie als Segmentierung hinzu.</translation>
    </message>
    <message>
        <source>%1: case '%2' has no MR '%3' on which it was drawn; it has %4</source>
        <translation>%1: Der Fall „%2“ hat kein MR „%3“, auf dem gezeichnet wurde; er hat %4</translation>
    </message>
    <message>
        <source>%1: several MR images have its grid; say on which it was drawn with FILE@%2 or FILE@%3</source>
        <translation>%1: Mehrere MR haben das gleiche Gitter; fügen Sie es noch einmal hinzu und wählen Sie, auf welchem gezeichnet wurde (%2 oder %3)</translation>
    </message>
    <message>
        <source>has another grid than the CT, which was repaired. If it was drawn on the slices as they lie in the files, by a program that takes them for straight and even, it lies elsewhere by up to %#1 mm: look whether it fits the bone</source>
        <translation>hat ein anderes Gitter als das CT, das repariert wurde. Wurde es auf den Schichten gezeichnet, wie sie in den Dateien liegen, mit einem Programm, das sie für gerade und gleichmäßig hält, so liegt es bis zu %#1 mm daneben: Sehen Sie nach, ob es zum Knochen passt</translation>
    </message>
    <message>
        <source>other</source>
        <translation>weitere</translation>
    </message>
    <message>
        <source>%~1 lies wholly outside the %2, so nothing of it is seen or felt; check that it is this patient's</source>
        <translation>%~1 liegt ganz außerhalb: %2. Nichts davon ist zu sehen oder zu fühlen; prüfen Sie, ob es zu diesem Patienten gehört</translation>
    </message>
    <message>
        <source>%~1 lie wholly outside the %2, so nothing of them is seen or felt; check that they are this patient's</source>
        <translation>%~1 liegen ganz außerhalb: %2. Nichts davon ist zu sehen oder zu fühlen; prüfen Sie, ob sie zu diesem Patienten gehören</translation>
    </message>
    <message>
        <source>partly outside the %~1, where nothing is seen or felt of them: %2</source>
        <translation>teilweise außerhalb des %~1, wo nichts von ihnen zu sehen oder zu fühlen ist: %2</translation>
    </message>
    <message>
        <source>its frame of reference could not be compared with the %~1's, as %~2; look whether it lies where it belongs</source>
        <translation>das Bezugssystem ließ sich mit dem des %~1 nicht vergleichen, da %~2; sehen Sie nach, ob die Lage stimmt</translation>
    </message>
    <message>
        <source>it states none</source>
        <translation>keines angegeben ist</translation>
    </message>
    <message>
        <source>%1: several MR images have its frame of reference; say on which it was drawn with FILE@%2 or FILE@%3</source>
        <translation>%1: Mehrere MR haben das gleiche Bezugssystem; fügen Sie es noch einmal hinzu und wählen Sie, auf welchem gezeichnet wurde (%2 oder %3)</translation>
    </message>
    <message>
        <source>the %1's is not known</source>
        <translation>das des %1 nicht bekannt ist</translation>
    </message>
    <message>
        <source>%#1 word of the files' names, which may be a patient's, was left out of the structures' names</source>
        <translation>%#1 Wort der Dateinamen, das zum Namen eines Patienten gehören kann, wurde aus den Namen der Strukturen weggelassen</translation>
    </message>
    <message>
        <source>%#1 word of the objects' names, which may be a patient's, was left out of the structures' names</source>
        <translation>%#1 Wort der Objektnamen, das zum Namen eines Patienten gehören kann, wurde aus den Namen der Strukturen weggelassen</translation>
    </message>
    <message>
        <source>%#1 words of the files' names, which may be a patient's, were left out of the structures' names</source>
        <translation>%#1 Wörter der Dateinamen, die zum Namen eines Patienten gehören können, wurden aus den Namen der Strukturen weggelassen</translation>
    </message>
    <message>
        <source>%#1 words of the objects' names, which may be a patient's, were left out of the structures' names</source>
        <translation>%#1 Wörter der Objektnamen, die zum Namen eines Patienten gehören können, wurden aus den Namen der Strukturen weggelassen</translation>
    </message>
    <message>
        <source>%~1 left out as asked, as the case has a part of this name already</source>
        <translation>%~1 blieb wie gewünscht weg, da der Fall schon einen Teil dieses Namens hat</translation>
    </message>
    <message>
        <source>%~1 left out as asked, as the case has parts of these names already</source>
        <translation>%~1 blieben wie gewünscht weg, da der Fall schon Teile dieser Namen hat</translation>
    </message>
    <message>
        <source>%~1 has a number, as other files of the folder give names that read the same; if a structure is there twice, remove one</source>
        <translation>%~1 hat eine Nummer, da andere Dateien des Ordners Namen ergeben, die sich gleich lesen; ist eine Struktur doppelt da, entfernen Sie eine</translation>
    </message>
    <message>
        <source>%~1 has a number, as other structures of the file have names that read the same; if a structure is there twice, remove one</source>
        <translation>%~1 hat eine Nummer, da andere Strukturen der Datei Namen haben, die sich gleich lesen; ist eine Struktur doppelt da, entfernen Sie eine</translation>
    </message>
    <message>
        <source>%~1 have a number, as other files of the folder give names that read the same; if a structure is there twice, remove one</source>
        <translation>%~1 haben eine Nummer, da andere Dateien des Ordners Namen ergeben, die sich gleich lesen; ist eine Struktur doppelt da, entfernen Sie eine</translation>
    </message>
    <message>
        <source>%~1 have a number, as other structures of the file have names that read the same; if a structure is there twice, remove one</source>
        <translation>%~1 haben eine Nummer, da andere Strukturen der Datei Namen haben, die sich gleich lesen; ist eine Struktur doppelt da, entfernen Sie eine</translation>
    </message>
    <message>
        <source>structure</source>
        <translation>Struktur</translation>
    </message>
    <message>
        <source>structure ct</source>
        <translation>Struktur ct</translation>
    </message>
    <message>
        <source>structure soft-tissue</source>
        <translation>Struktur soft-tissue</translation>
    </message>
    <message>
        <source>structure '%1' has this name since its own is too long, taken or reserved, or has characters that are not seen</source>
        <translation>Struktur „%1“ heißt so, da der eigene Name zu lang, vergeben oder reserviert ist oder unsichtbare Zeichen hat</translation>
    </message>
    <message>
        <source>%1: has %#2 structures or different values, and at most %#3 are taken as structures; an image is added as an MR, and of an atlas only what is needed</source>
        <translation>%1: hat %#2 Strukturen oder verschiedene Werte, und höchstens %#3 werden als Strukturen übernommen; ein Bild wird als MR hinzugefügt, und von einem Atlas nur das, was gebraucht wird</translation>
    </message>
    <message>
        <source>label %#1</source>
        <translation>Label %#1</translation>
    </message>
    <message>
        <source>%#1 values without a name became a structure each; if it is an image, remove them and add it as an MR</source>
        <translation>%#1 Werte ohne Namen wurden je eine Struktur; ist es ein Bild, entfernen Sie sie und fügen Sie es als MR hinzu</translation>
    </message>
    <message>
        <source>states another patient's ID, name or date of birth than the case's images; it was added as asked</source>
        <translation>nennt eine andere Patienten-ID, einen anderen Namen oder ein anderes Geburtsdatum als die Bilder des Falls; wie gewünscht hinzugefügt</translation>
    </message>
    <message>
        <source>%#1 file of the folder is not a mask of one structure, and left out</source>
        <translation>%#1 Datei des Ordners ist keine Maske einer Struktur und blieb weg</translation>
    </message>
    <message>
        <source>%#1 file of the folder is not a mask of one structure, and left out: %~2</source>
        <translation>%#1 Datei des Ordners ist keine Maske einer Struktur und blieb weg: %~2</translation>
    </message>
    <message>
        <source>%#1 file of the folder is not a mask of one structure, and left out, among them %~2</source>
        <translation>%#1 Datei des Ordners ist keine Maske einer Struktur und blieb weg, darunter %~2</translation>
    </message>
    <message>
        <source>%#1 files of the folder are not a mask of one structure, and left out</source>
        <translation>%#1 Dateien des Ordners sind keine Masken einer Struktur und blieben weg</translation>
    </message>
    <message>
        <source>%#1 files of the folder are not a mask of one structure, and left out: %~2</source>
        <translation>%#1 Dateien des Ordners sind keine Masken einer Struktur und blieben weg: %~2</translation>
    </message>
    <message>
        <source>%#1 files of the folder are not a mask of one structure, and left out, among them %~2</source>
        <translation>%#1 Dateien des Ordners sind keine Masken einer Struktur und blieben weg, darunter %~2</translation>
    </message>
    <message>
        <source>reading labels</source>
        <translation>Labels werden gelesen</translation>
    </message>
    <message>
        <source>%1: none of its structures has a voxel; export it again with what was drawn</source>
        <translation>%1: Keine der Strukturen hat ein Voxel; exportieren Sie neu, mit dem Gezeichneten</translation>
    </message>
    <message>
        <source>%~1 left out, as no voxel carries it</source>
        <translation>%~1 blieb weg, da kein Voxel dazu gehört</translation>
    </message>
    <message>
        <source>%~1 left out, as no voxel carries them</source>
        <translation>%~1 blieben weg, da kein Voxel dazu gehört</translation>
    </message>
    <message>
        <source>%1: reaches %#2 mm beyond %~3, and a surface of this patient at most %#4 mm; look for a coordinate without its decimal point, and give it in mm</source>
        <translation>%1: reicht %#2 mm über %~3 hinaus, eine Oberfläche dieses Patienten höchstens %#4 mm; suchen Sie eine Koordinate ohne Dezimalpunkt, und geben Sie die Datei in mm</translation>
    </message>
    <message>
        <source>mesh</source>
        <translation>Netz</translation>
    </message>
    <message>
        <source>named so as another part has the name of its file</source>
        <translation>so benannt, da ein anderer Teil den Namen der Datei hat</translation>
    </message>
    <message>
        <source>%1: holds %#2 objects, and at most %#3 are taken as structures; add it as one, without --mesh-parts</source>
        <translation>%1: enthält %#2 Objekte, und höchstens %#3 werden als Strukturen genommen; fügen Sie die Datei als eine einzige hinzu</translation>
    </message>
    <message>
        <source>reading mesh</source>
        <translation>Netz wird gelesen</translation>
    </message>
    <message>
        <source>is one of %#1 objects of its file; what is noted here of names, coordinates and unit is of all of them</source>
        <translation>ist eines von %#1 Objekten seiner Datei; was hier zu Namen, Koordinaten und Einheit angemerkt ist, gilt für alle</translation>
    </message>
    <message>
        <source>the MR on which it was drawn</source>
        <translation>das MR, auf dem gezeichnet wurde</translation>
    </message>
    <message>
        <source>the %~1</source>
        <translation>das %~1</translation>
    </message>
    <message>
        <source>%1: '%2' is the name of what the same file gives, too; leave one of them out, or give one another name with NAME=FILE, or a number with --rename-taken</source>
        <translation>%1: „%2“ heißt schon, was dieselbe Datei ergibt; lassen Sie eines davon weg, oder geben Sie einem einen anderen Namen</translation>
    </message>
    <message>
        <source>%1: '%2' is the name of what %3 gives, too; leave one of them out, or give one another name with NAME=FILE, or a number with --rename-taken</source>
        <translation>%1: „%2“ heißt schon, was %3 ergibt; lassen Sie eines davon weg, oder geben Sie einem einen anderen Namen</translation>
    </message>
    <message>
        <source>the same file</source>
        <translation>dieselbe Datei</translation>
    </message>
    <message>
        <source>%1: does not say which side of the patient is left (NIfTI: qform or sform, NRRD: space, MetaImage: TransformMatrix), so the anatomy could be mirrored; export it again with its geometry, or say %2 ras (NIfTI's own) or lps (DICOM, ITK) if you know it</source>
        <translation>%1: sagt nicht, welche Seite des Patienten links ist (NIfTI: qform oder sform, NRRD: space, MetaImage: TransformMatrix), die Anatomie könnte gespiegelt sein; exportieren Sie die Datei mit ihrer Geometrie neu (%2)</translation>
    </message>
    <message>
        <source>%#1 mm if its numbers are in %~2</source>
        <translation>%#1 mm, wenn die Zahlen in %~2 sind</translation>
    </message>
    <message>
        <source>%#1 mm long by the unit of length that it states, which is no head, ear or specimen; it is %~2</source>
        <translation>nach der Längeneinheit, die sie nennt, %#1 mm lang, was kein Kopf, Ohr oder Präparat ist; sie ist %~2</translation>
    </message>
    <message>
        <source>%#1 mm long, as it states no unit of length and mm was taken, which is no head, ear or specimen; it is %~2</source>
        <translation>%#1 mm lang, da sie keine Längeneinheit nennt und mm angenommen wurde, was kein Kopf, Ohr oder Präparat ist; sie ist %~2</translation>
    </message>
    <message>
        <source>%1: is %~2. Export it again with its unit, or say it with %3</source>
        <translation>%1: ist %~2. Exportieren Sie die Datei mit ihrer Einheit neu, oder nennen Sie sie mit %3</translation>
    </message>
    <message>
        <source>and '%1'</source>
        <translation>und „%1“</translation>
    </message>
    <message>
        <source>is the name of a part that is in the case already</source>
        <translation>ist der Name eines Teils, der schon im Fall ist</translation>
    </message>
    <message>
        <source>are names of parts that are in the case already</source>
        <translation>sind Namen von Teilen, die schon im Fall sind</translation>
    </message>
    <message>
        <source>give its structures other names with NAME=FILE, which puts NAME before each, or numbers with --rename-taken</source>
        <translation>benennen Sie erst die des Falls um (F2 in der Liste)</translation>
    </message>
    <message>
        <source>or leave this one out and add the other one with --skip-taken</source>
        <translation>oder lassen Sie diese weg und fügen Sie die andere hinzu</translation>
    </message>
    <message>
        <source>or leave this one out and add the other %#1 with --skip-taken</source>
        <translation>oder lassen Sie diese weg und fügen Sie die anderen %#1 hinzu</translation>
    </message>
    <message>
        <source>or leave these out and add the other one with --skip-taken</source>
        <translation>oder lassen Sie diese weg und fügen Sie die andere hinzu</translation>
    </message>
    <message>
        <source>or leave these out and add the other %#1 with --skip-taken</source>
        <translation>oder lassen Sie diese weg und fügen Sie die anderen %#1 hinzu</translation>
    </message>
    <message>
        <source>one</source>
        <translation>eine</translation>
    </message>
    <message>
        <source>%1: was drawn in another frame of reference than the %2's, so its place in the %3 is not known; if it is this %4's all the same, say FILE@ct, or add the MR on which it was drawn</source>
        <translation>%1: wurde in einem anderen Bezugssystem gezeichnet als dem des %2, die Lage im %3 ist daher nicht bekannt; gehört es doch zu diesem %4, fügen Sie es noch einmal hinzu und wählen Sie „auf dem CT“, oder fügen Sie das MR hinzu, auf dem gezeichnet wurde</translation>
    </message>
    <message>
        <source>%1: does not tell whether it lies in the space of '%2' as its file states it, or with its axes corrected (%3); say FILE@%4 if it follows the correction, %5 LPS if it lies where it belongs already</source>
        <translation>%1: sagt nicht, ob sie im Raum von „%2“ liegt, wie dessen Datei ihn angibt, oder mit korrigierten Achsen (%3); sagen Sie DATEI@%4, wenn sie der Korrektur folgt, %5 LPS, wenn sie schon richtig liegt</translation>
    </message>
    <message>
        <source>%1: has another grid than the CT, which was repaired; drawn on the slices as they lie in the files, by a program that takes them for straight and even, it lies elsewhere by up to %#2 mm. Say --labels-as-they-lie if it is to be added where it lies, and look whether it fits the bone</source>
        <translation>%1: hat ein anderes Gitter als das CT, das repariert wurde; auf den Schichten gezeichnet, wie sie in den Dateien liegen, von einem Programm, das sie für gerade und gleichmäßig hält, liegt sie bis zu %#2 mm anderswo. Fügen Sie sie noch einmal hinzu, so wie sie liegt, und sehen Sie nach, ob sie zum Knochen passt</translation>
    </message>
    <message>
        <source>%1: states another patient than the case's images do (what differs: %~2); look whether it is this patient's, and say --other-patient if it is to be added all the same</source>
        <translation>%1: nennt einen anderen Patienten als die Bilder des Falls (es unterscheiden sich: %~2); sehen Sie nach, ob es dieser Patient ist</translation>
    </message>
    <message>
        <source>read</source>
        <translation>gelesen</translation>
    </message>
    <message>
        <source>empty</source>
        <translation>leer</translation>
    </message>
    <message>
        <source>skipped</source>
        <translation>übersprungen</translation>
    </message>
    <message>
        <source>unread</source>
        <translation>nicht gelesen</translation>
    </message>
    <message>
        <source>%#1 structure read</source>
        <translation>%#1 Struktur gelesen</translation>
    </message>
    <message>
        <source>%#1 structures read</source>
        <translation>%#1 Strukturen gelesen</translation>
    </message>
    <message>
        <source>%#1 empty</source>
        <translation>%#1 leer</translation>
    </message>
    <message>
        <source>%#1 left out</source>
        <translation>%#1 blieben weg</translation>
    </message>
    <message>
        <source>%#1 not read</source>
        <translation>%#1 nicht gelesen</translation>
    </message>
    <message>
        <source>%~1 '%2' is in the case already; give it another name</source>
        <translation>%~1 „%2“ ist schon im Fall; geben Sie einen anderen Namen</translation>
    </message>
    <message>
        <source>structure '%1' has no voxel yet</source>
        <translation>Struktur „%1“ hat noch kein Voxel</translation>
    </message>
    <message>
        <source>it lies wholly outside of the image</source>
        <translation>sie liegt ganz außerhalb des Bildes</translation>
    </message>
    <message>
        <source>series</source>
        <translation>Serie</translation>
    </message>
    <message>
        <source>not recorded</source>
        <translation>nicht aufgezeichnet</translation>
    </message>
    <message>
        <source>the library's salt was lost, so it cannot be compared with the patient's name; it goes along where that salt is restored from a copy, or the images are imported again</source>
        <translation>das Salt der Bibliothek ging verloren, daher lässt er sich nicht mit dem Patientennamen vergleichen; er geht mit, wenn dieses Salt aus einer Kopie wiederhergestellt ist oder die Bilder neu importiert sind</translation>
    </message>
    <message>
        <source>the patient's name in its files has no word with which to compare it, as that of a phantom or a number has none (of images that an older version imported, none was kept); it goes along where the images are imported again, of files with a person's name</source>
        <translation>der Patientenname in seinen Dateien hat kein Wort, mit dem er sich vergleichen ließe, wie der eines Phantoms oder eine Zahl keines hat (von Bildern, die eine ältere Version importierte, wurde keines behalten); er geht mit, wenn die Bilder neu importiert sind, aus Dateien mit dem Namen einer Person</translation>
    </message>
    <message>
        <source>nothing is known of the patient's name with which to compare it; it goes along where the case was made of DICOM files that state the patient's name, in this library</source>
        <translation>vom Namen des Patienten, mit dem er verglichen werden könnte, ist nichts bekannt; er geht mit, wenn der Fall in dieser Bibliothek aus DICOM-Dateien entstand, die den Patientennamen angeben</translation>
    </message>
    <message>
        <source>it may be the patient's name, number or date; it goes along where the case is renamed</source>
        <translation>er kann Name, Nummer oder Datum des Patienten sein; er geht mit, wenn der Fall umbenannt ist</translation>
    </message>
    <message>
        <source>a word of one or two letters cannot be compared with the patient's name; it goes along where the case is renamed to one without</source>
        <translation>ein Wort von einem oder zwei Buchstaben lässt sich nicht mit dem Patientennamen vergleichen; er geht mit, wenn der Fall in einen ohne ein solches umbenannt ist</translation>
    </message>
    <message>
        <source>bringing the structures onto one grid</source>
        <translation>Strukturen werden auf ein Gitter gebracht</translation>
    </message>
    <message>
        <source>petrous case %1</source>
        <translation>Petrous-Fall %1</translation>
    </message>
    <message>
        <source>study of case %1</source>
        <translation>Studie des Falls %1</translation>
    </message>
    <message>
        <source>study</source>
        <translation>Studie</translation>
    </message>
    <message>
        <source>export %~1: its voxels are fractions, and spread too far for the 16 bits of a DICOM series to hold them within half a unit; write %~2</source>
        <translation>Export %~1: Die Voxel sind gebrochene Zahlen und liegen zu weit auseinander, als dass die 16 Bit einer DICOM-Serie sie auf eine halbe Einheit genau fassen; schreiben Sie %~2</translation>
    </message>
    <message>
        <source>MR, resampled on the CT</source>
        <translation>MR, auf das CT umgerechnet</translation>
    </message>
    <message>
        <source>the voxels of %1 are fractions and were written in 16 bits with a rescale slope; they are off by up to %#2</source>
        <translation>die Voxel von %1 sind gebrochene Zahlen und wurden mit einer Steigung in 16 Bit geschrieben; sie weichen um bis zu %#2 ab</translation>
    </message>
    <message>
        <source>slice %~1 interpolated between neighbours: nothing was measured there</source>
        <translation>Schicht %~1 zwischen Nachbarn interpoliert: dort wurde nichts gemessen</translation>
    </message>
    <message>
        <source>slices %~1 interpolated between neighbours: nothing was measured there</source>
        <translation>Schichten %~1 zwischen Nachbarn interpoliert: dort wurde nichts gemessen</translation>
    </message>
    <message>
        <source>%#1 structures: %2</source>
        <translation>%#1 Strukturen: %2</translation>
    </message>
    <message>
        <source>%#1 structures</source>
        <translation>%#1 Strukturen</translation>
    </message>
    <message>
        <source>labels</source>
        <translation>Labels</translation>
    </message>
    <message>
        <source>case '%1' has no MR</source>
        <translation>der Fall „%1“ hat kein MR</translation>
    </message>
    <message>
        <source>export mr: give --part NAME; there are: %1</source>
        <translation>MR exportieren: Wählen Sie eines; es gibt: %1</translation>
    </message>
    <message>
        <source>resampling</source>
        <translation>Umrechnen</translation>
    </message>
    <message>
        <source>'%1' lies on the CT</source>
        <translation>„%1“ liegt auf dem CT</translation>
    </message>
    <message>
        <source>'%1' lies on the MR '%2', which is elsewhere</source>
        <translation>„%1“ liegt auf dem MR „%2“, das anderswo liegt</translation>
    </message>
    <message>
        <source>'%1' has voxels of %2 mm from (%3) on</source>
        <translation>„%1“ hat Voxel von %2 mm ab (%3)</translation>
    </message>
    <message>
        <source>'%1' reaches beyond the CT; what is outside is not written</source>
        <translation>„%1“ reicht über das CT hinaus; was außerhalb liegt, wird nicht geschrieben</translation>
    </message>
    <message>
        <source>'%1' has no voxel on the CT's grid, of %2: the rest lies outside of it; without --on-ct it is written whole</source>
        <translation>„%1“ hat kein Voxel auf dem Gitter des CT, von %2: Der Rest liegt außerhalb; ohne --on-ct wird es ganz geschrieben</translation>
    </message>
    <message>
        <source>'%1' has no voxel on the CT's grid, of %2: its voxels are finer than the CT's; without --on-ct it keeps its own</source>
        <translation>„%1“ hat auf dem Gitter des CT kein Voxel, von %2: Die Voxel sind feiner als die des CT; auf dem eigenen Gitter bleiben sie erhalten</translation>
    </message>
    <message>
        <source>'%1' has %#2 mm3 on the CT's grid, of %3: the rest lies outside of it; without --on-ct it is written whole</source>
        <translation>„%1“ hat %#2 mm³ auf dem Gitter des CT, von %3: Der Rest liegt außerhalb; ohne --on-ct wird es ganz geschrieben</translation>
    </message>
    <message>
        <source>'%1' has %#2 mm3 on the CT's grid, of %3: its voxels are finer than the CT's; without --on-ct it keeps its own</source>
        <translation>„%1“ hat %#2 mm³ auf dem Gitter des CT, von %3: Die Voxel sind feiner als die des CT; auf dem eigenen Gitter bleiben sie erhalten</translation>
    </message>
    <message>
        <source>export labels: '%1' is missing or damaged, and nothing else is asked for</source>
        <translation>Labels exportieren: „%1“ fehlt oder ist beschädigt, und nichts anderes ist gewünscht</translation>
    </message>
    <message>
        <source>export labels: '%1' %2</source>
        <translation>Labels exportieren: „%1“ %2</translation>
    </message>
    <message>
        <source>'%1' is written where its MR has it, not on the CT: %2</source>
        <translation>„%1“ wird geschrieben, wo das MR es hat, nicht auf dem CT: %2</translation>
    </message>
    <message>
        <source>export labels: %~1, and %~2; register the MR first, or export it alone with --part</source>
        <translation>Labels exportieren: %~1, und %~2; registrieren Sie erst das MR (F5), oder exportieren Sie es allein</translation>
    </message>
    <message>
        <source>case '%1' has no structures</source>
        <translation>der Fall „%1“ hat keine Strukturen</translation>
    </message>
    <message>
        <source>case '%1' has no structure '%2'</source>
        <translation>der Fall „%1“ hat keine Struktur „%2“</translation>
    </message>
    <message>
        <source>export labels: %~1, and %~2: no one grid holds both without resampling; export it alone with --part, or all on the %~3's grid with --on-ct</source>
        <translation>Labels exportieren: %~1, und %~2: Kein Gitter fasst beides ohne Umrechnen; exportieren Sie es allein, oder alles auf dem Gitter des %~3</translation>
    </message>
    <message>
        <source>writing structures</source>
        <translation>Strukturen werden geschrieben</translation>
    </message>
    <message>
        <source>'%1': %#2 voxels are not written, as structures before it have them; .seg.nrrd and .dcm keep structures that overlap</source>
        <translation>„%1“: %#2 Voxel werden nicht geschrieben, da Strukturen davor sie haben; .seg.nrrd und .dcm behalten Strukturen, die sich überlappen</translation>
    </message>
    <message>
        <source>the image</source>
        <translation>das Bild</translation>
    </message>
    <message>
        <source>surface</source>
        <translation>Oberfläche</translation>
    </message>
    <message>
        <source>--on-ct is for --what mr and labels</source>
        <translation>Auf dem Gitter des CT gibt es MR und Labels</translation>
    </message>
    <message>
        <source>--triangles is for --what surface and structure</source>
        <translation>Eine Zahl von Dreiecken gibt es für Oberfläche und Struktur</translation>
    </message>
    <message>
        <source>dissected</source>
        <translation>präpariert</translation>
    </message>
    <message>
        <source>--mask-face and --roi are for --what ct, mr, dissected and surface</source>
        <translation>Gesicht maskieren und Bereich gibt es für CT, MR, Präparat und Oberfläche</translation>
    </message>
    <message>
        <source>export structure: give --part NAME</source>
        <translation>Struktur exportieren: Wählen Sie eine</translation>
    </message>
    <message>
        <source>not decimated</source>
        <translation>nicht verkleinert</translation>
    </message>
    <message>
        <source>it keeps %#1 triangles instead of %#2: %~3 (it is of %#4 pieces that are not connected)</source>
        <translation>es bleiben %#1 Dreiecke statt %#2: %~3 (es sind %#4 Stücke, die nicht zusammenhängen)</translation>
    </message>
    <message>
        <source>it keeps %#1 triangles instead of %#2: %~3</source>
        <translation>es bleiben %#1 Dreiecke statt %#2: %~3</translation>
    </message>
    <message>
        <source>the decimated surface passes through itself in %#1 pairs of triangles; ask for more triangles if the other program objects</source>
        <translation>die verkleinerte Oberfläche durchdringt sich selbst in %#1 Paaren von Dreiecken; nehmen Sie mehr Dreiecke, falls das andere Programm sie ablehnt</translation>
    </message>
    <message>
        <source>decimated from %#1, at most %#2 mm from it (mean %#3 mm)</source>
        <translation>verkleinert von %#1, höchstens %#2 mm davon entfernt (im Mittel %#3 mm)</translation>
    </message>
    <message>
        <source>%#1 triangles, %~2, closed, %#3 mm3</source>
        <translation>%#1 Dreiecke, %~2, geschlossen, %#3 mm³</translation>
    </message>
    <message>
        <source>%#1 triangles, %~2, not closed</source>
        <translation>%#1 Dreiecke, %~2, nicht geschlossen</translation>
    </message>
    <message>
        <source>export mr: '%1' is not registered with the %~2; register it first</source>
        <translation>MR exportieren: „%1“ ist nicht mit dem %~2 registriert; registrieren Sie es erst</translation>
    </message>
    <message>
        <source>its names in %1</source>
        <translation>die Namen in %1</translation>
    </message>
    <message>
        <source>mask</source>
        <translation>Maske</translation>
    </message>
    <message>
        <source>the name of the case is not the patient's name in the files, but the ID '%1': %~2</source>
        <translation>Der Name des Falls ist in den Dateien nicht der Patientenname, sondern die ID „%1“: %~2</translation>
    </message>
    <message>
        <source>case</source>
        <translation>Fall</translation>
    </message>
    <message>
        <source>the library has a case '%1' already; take another name</source>
        <translation>die Bibliothek hat schon einen Fall „%1“; wählen Sie einen anderen Namen</translation>
    </message>
    <message>
        <source>Cut away for the view, not drilled</source>
        <translation>Für die Ansicht weggeschnitten, nicht gebohrt</translation>
    </message>
    <message>
        <source>Only a part of the image is shown</source>
        <translation>Nur ein Teil des Bildes wird gezeigt</translation>
    </message>
    <message>
        <source>drawing a thumbnail</source>
        <translation>Vorschaubild wird gezeichnet</translation>
    </message>
    <message>
        <source>case '%1' has no CT: its primary image is an MR; send 'mr'</source>
        <translation>der Fall „%1“ hat kein CT: sein Hauptbild ist ein MR; senden Sie das MR</translation>
    </message>
    <message>
        <source>send: %~1</source>
        <translation>Senden: %~1</translation>
    </message>
    <message>
        <source>%~1; it is not sent by itself</source>
        <translation>%~1; allein wird es nicht gesendet</translation>
    </message>
    <message>
        <source>the voxels of '%1' are fractions, which 16 bits of a DICOM series do not hold within half a unit</source>
        <translation>die Voxel von „%1“ sind gebrochene Zahlen, die 16 Bit einer DICOM-Serie nicht auf eine halbe Einheit genau fassen</translation>
    </message>
    <message>
        <source>scene%1</source>
        <translation>Szene%1</translation>
    </message>
    <message>
        <source>node '%1' still has %#2 segmentation of an earlier state of this case, which 'petrous receive --study' would take for the latest; have what is superseded deleted there</source>
        <translation>der Knoten „%1“ hat noch %#2 Segmentierung eines früheren Standes dieses Falls, die beim Empfangen als neueste gälte; lassen Sie das Überholte dort löschen</translation>
    </message>
    <message>
        <source>node '%1' still has %#2 segmentation of an earlier state of this case; have what is superseded deleted there</source>
        <translation>der Knoten „%1“ hat noch %#2 Segmentierung eines früheren Standes dieses Falls; lassen Sie das Überholte dort löschen</translation>
    </message>
    <message>
        <source>node '%1' still has %#2 segmentations of an earlier state of this case, which 'petrous receive --study' would take for the latest; have what is superseded deleted there</source>
        <translation>der Knoten „%1“ hat noch %#2 Segmentierungen eines früheren Standes dieses Falls, die beim Empfangen als neueste gälten; lassen Sie das Überholte dort löschen</translation>
    </message>
    <message>
        <source>node '%1' still has %#2 segmentations of an earlier state of this case; have what is superseded deleted there</source>
        <translation>der Knoten „%1“ hat noch %#2 Segmentierungen eines früheren Standes dieses Falls; lassen Sie das Überholte dort löschen</translation>
    </message>
    <message>
        <source>node '%1': has no scene of a case '%2'; give --study UID for a study that was not sent by Petrous, or by another library without the name of the case ('petrous receive --list' lists those)</source>
        <translation>Knoten „%1“: hat keine Szene eines Falls „%2“; geben Sie --study UID an für eine Studie, die nicht von Petrous gesendet wurde oder von einer anderen Bibliothek ohne den Namen des Falls („petrous receive --list“ listet sie auf)</translation>
    </message>
    <message>
        <source>node '%1': has %#2 cases named '%3'; give --study UID, which 'petrous send' printed and 'petrous receive --list' lists</source>
        <translation>Knoten „%1“: hat %#2 Fälle namens „%3“; wählen Sie die Studie</translation>
    </message>
    <message>
        <source>case '%1' is there already in %2; choose another name with --as</source>
        <translation>ein Fall „%1“ ist schon in %2; wählen Sie einen anderen Namen</translation>
    </message>
    <message>
        <source>'%1' (%#2 images, doubtful)</source>
        <translation>„%1“ (%#2 Bilder, zweifelhaft)</translation>
    </message>
    <message>
        <source>receive: the CT has %#1 volumes; name one by --volume: %2</source>
        <translation>Empfangen: das CT hat %#1 Volumen; wählen Sie eines: %2</translation>
    </message>
    <message>
        <source>an MR series is left out, as its geometry is doubtful; try --repair</source>
        <translation>eine MR-Serie blieb weg, da ihre Geometrie zweifelhaft ist; versuchen Sie die Reparatur</translation>
    </message>
    <message>
        <source>a segmentation of the study is left out: it does not belong to these images, cannot be read, or names structures of another one, and the node does not tell which is the later; compare them there</source>
        <translation>eine Segmentierung der Studie blieb weg: Sie gehört nicht zu diesen Bildern, ist nicht lesbar oder nennt Strukturen einer anderen, und der Knoten sagt nicht, welche die spätere ist; vergleichen Sie dort</translation>
    </message>
    <message>
        <source>a segmentation of the study is left out: it does not belong to these images, cannot be read, or names structures that are there already</source>
        <translation>eine Segmentierung der Studie blieb weg: Sie gehört nicht zu diesen Bildern, ist nicht lesbar oder nennt Strukturen, die schon da sind</translation>
    </message>
    <message>
        <source>a segmentation of an earlier state is left out: the latest by its series number was taken</source>
        <translation>eine Segmentierung eines früheren Standes blieb weg: Genommen wurde die neueste nach ihrer Seriennummer</translation>
    </message>
    <message>
        <source>%#1 segmentations of earlier states are left out: the latest by its series number was taken</source>
        <translation>%#1 Segmentierungen früherer Stände blieben weg: Genommen wurde die neueste nach ihrer Seriennummer</translation>
    </message>
    <message>
        <source>%1 (%#2 images)</source>
        <translation>%1 (%#2 Bilder)</translation>
    </message>
    <message>
        <source>node '%1': the study has %#2 CT series; name one by --series: %3</source>
        <translation>Knoten „%1“: Die Studie hat %#2 CT-Serien; wählen Sie eine: %3</translation>
    </message>
    <message>
        <source>node '%1' does not describe series %#2, which may hold a later state of the case, but was not read as one: %~3</source>
        <translation>der Knoten „%1“ beschreibt die Serie %#2 nicht, die ein späterer Stand des Falls sein kann, aber nicht als solcher gelesen wurde: %~3</translation>
    </message>
    <message>
        <source>a later state of the case is at node '%1', but cannot be received: %~2. This is the state before it</source>
        <translation>beim Knoten „%1“ liegt ein späterer Stand des Falls, der sich nicht empfangen lässt: %~2. Dies ist der Stand davor</translation>
    </message>
    <message>
        <source>node '%1' does not describe series %#2, which may hold a case of Petrous, but was not read as one: %~3</source>
        <translation>der Knoten „%1“ beschreibt die Serie %#2 nicht, die ein Fall von Petrous sein kann, aber nicht als solcher gelesen wurde: %~3</translation>
    </message>
    <message>
        <source>May identify the patient</source>
        <translation>Kann den Patienten erkennen lassen</translation>
    </message>
    <message>
        <source>Look at these</source>
        <translation>Sehen Sie diese an</translation>
    </message>
    <message>
        <source>Goes along</source>
        <translation>Geht mit</translation>
    </message>
    <message>
        <source>Stays here</source>
        <translation>Bleibt hier</translation>
    </message>
    <message>
        <source>%~1: who sees it can recognise the patient. Mask it (--mask-face; in the window: put air in place of the face), or hand on the region of the ear alone (--roi; in the window: File &gt; Open a region)</source>
        <translation>%~1: Wer es sieht, kann den Patienten erkennen. Maskieren Sie es (--mask-face; im Fenster: Luft an die Stelle des Gesichts setzen), oder geben Sie allein die Region des Ohrs weiter (--roi; im Fenster: Datei &gt; Ausschnitt öffnen)</translation>
    </message>
    <message>
        <source>the image holds a whole head, and its face was left</source>
        <translation>das Bild enthält einen ganzen Kopf, und sein Gesicht blieb</translation>
    </message>
    <message>
        <source>%~1: %#2 of %#3 may be a patient's name, number or date; change what is one before you send</source>
        <translation>%~1: %#2 von %#3 kann Name, Nummer oder Datum eines Patienten sein; ändern Sie solche vor dem Senden</translation>
    </message>
    <message>
        <source>%~1, which may be a patient's: %2</source>
        <translation>%~1, vielleicht von einem Patienten: %2</translation>
    </message>
    <message>
        <source>MR '%1'</source>
        <translation>MR „%1“</translation>
    </message>
    <message>
        <source>the pixels of %~1 may have text in them, which may name the patient: look at them</source>
        <translation>die Pixel von %~1 können Text enthalten, der den Patienten nennt: sehen Sie nach</translation>
    </message>
    <message>
        <source>the face was left in %~1</source>
        <translation>das Gesicht blieb in %~1</translation>
    </message>
    <message>
        <source>the face was left in %~1: who sees it can recognise the patient, and it cannot be masked</source>
        <translation>das Gesicht blieb in %~1: Wer es sieht, kann den Patienten erkennen, und es lässt sich nicht maskieren</translation>
    </message>
    <message>
        <source>%#1 x %#2 x %#3 voxels</source>
        <translation>%#1 x %#2 x %#3 Voxel</translation>
    </message>
    <message>
        <source>CT: %1 and their place in space</source>
        <translation>CT: %1 und ihre Lage im Raum</translation>
    </message>
    <message>
        <source>MR: %1 and their place in space</source>
        <translation>MR: %1 und ihre Lage im Raum</translation>
    </message>
    <message>
        <source>MR '%1': %2 and their place in space</source>
        <translation>MR „%1“: %2 und ihre Lage im Raum</translation>
    </message>
    <message>
        <source>the names of structures: %~1</source>
        <translation>die Namen der Strukturen: %~1</translation>
    </message>
    <message>
        <source>structures, by their names: %~1</source>
        <translation>Strukturen, mit ihren Namen: %~1</translation>
    </message>
    <message>
        <source>the plan by its name '%1': strokes, approaches, appearance, views, landmarks</source>
        <translation>der Plan mit seinem Namen „%1“: Bohrzüge, Zugänge, Darstellung, Ansichten, Landmarken</translation>
    </message>
    <message>
        <source>the scene by its name '%1': strokes, approaches, appearance, views, landmarks</source>
        <translation>die Szene mit ihrem Namen „%1“: Bohrzüge, Zugänge, Darstellung, Ansichten, Landmarken</translation>
    </message>
    <message>
        <source>the names of meshes: %~1</source>
        <translation>die Namen der Netze: %~1</translation>
    </message>
    <message>
        <source>meshes, by their names: %~1</source>
        <translation>Netze, mit ihren Namen: %~1</translation>
    </message>
    <message>
        <source>the surface of the instrument, without the name of its file</source>
        <translation>die Oberfläche des Instruments, ohne den Namen seiner Datei</translation>
    </message>
    <message>
        <source>names of structures that are gone, in strokes that touched them: %~1</source>
        <translation>Namen von Strukturen, die nicht mehr da sind, in Bohrzügen, die sie berührten: %~1</translation>
    </message>
    <message>
        <source>what was noted on import and registration: %#1 sentence</source>
        <translation>was bei Import und Registrierung vermerkt wurde: %#1 Satz</translation>
    </message>
    <message>
        <source>what was noted on import and registration: %#1 sentences</source>
        <translation>was bei Import und Registrierung vermerkt wurde: %#1 Sätze</translation>
    </message>
    <message>
        <source>what was noted of parts that the case does not have any more, or calls otherwise by now</source>
        <translation>was zu Teilen vermerkt wurde, die der Fall nicht mehr hat oder inzwischen anders nennt</translation>
    </message>
    <message>
        <source>what was noted on import and registration: has what may be a patient's name, number or date; look at the notes of the case</source>
        <translation>was bei Import und Registrierung vermerkt wurde: enthält, was Name, Nummer oder Datum eines Patienten sein kann; lesen Sie die Vermerke des Falls</translation>
    </message>
    <message>
        <source>marks of the patient and of the scanner's frame of reference, sealed: nobody but this library can read them, or tell by them that two cases are of one patient</source>
        <translation>Kennzeichen des Patienten und des Bezugssystems des Geräts, versiegelt: Nur diese Bibliothek kann sie lesen oder daran erkennen, dass zwei Fälle von einem Patienten sind</translation>
    </message>
    <message>
        <source>the names of MRs: %~1</source>
        <translation>die Namen der MR: %~1</translation>
    </message>
    <message>
        <source>tags, diagnosis and procedure: %~1</source>
        <translation>Schlagwörter, Diagnose und Eingriff: %~1</translation>
    </message>
    <message>
        <source>the note, as it is</source>
        <translation>die Notiz, wie sie ist</translation>
    </message>
    <message>
        <source>the note</source>
        <translation>die Notiz</translation>
    </message>
    <message>
        <source>the planned date of the operation</source>
        <translation>das geplante Datum der Operation</translation>
    </message>
    <message>
        <source>the planned date: together with a list of the day's operations it tells who the patient is</source>
        <translation>das geplante Datum: Zusammen mit dem Operationsprogramm des Tages sagt es, wer der Patient ist</translation>
    </message>
    <message>
        <source>date and time of each stroke</source>
        <translation>Datum und Uhrzeit jedes Bohrzugs</translation>
    </message>
    <message>
        <source>who signed the registration of MR '%1', and when</source>
        <translation>wer die Registrierung des MR „%1“ freigegeben hat, und wann</translation>
    </message>
    <message>
        <source>%1 (it stays marked as signed)</source>
        <translation>%1 (als freigegeben bleibt sie gekennzeichnet)</translation>
    </message>
    <message>
        <source>%1: a clinician's name and a date lead to the hospital's patients of that day</source>
        <translation>%1: Name eines Arztes und Datum führen zu den Patienten des Krankenhauses an diesem Tag</translation>
    </message>
    <message>
        <source>the dates of attachments</source>
        <translation>die Daten der Anlagen</translation>
    </message>
    <message>
        <source>attachments: %~1</source>
        <translation>Anlagen: %~1</translation>
    </message>
    <message>
        <source>attachments: what they show and say is not looked at, and only screenshots are cleaned of metadata</source>
        <translation>Anlagen: Was sie zeigen und sagen, wird nicht geprüft, und nur aus Bildschirmfotos werden Metadaten entfernt</translation>
    </message>
    <message>
        <source>names and notes of attachments</source>
        <translation>Namen und Notizen der Anlagen</translation>
    </message>
    <message>
        <source>marks and measurements: %~1</source>
        <translation>Marken und Messungen: %~1</translation>
    </message>
    <message>
        <source>the note: has what may be a patient's name, number or date, and nothing is removed from it</source>
        <translation>die Notiz: enthält, was Name, Nummer oder Datum eines Patienten sein kann, und nichts wird daraus entfernt</translation>
    </message>
    <message>
        <source>the note: read it once more, nothing is removed from it</source>
        <translation>die Notiz: Lesen Sie sie noch einmal, nichts wird daraus entfernt</translation>
    </message>
    <message>
        <source>names of structures</source>
        <translation>Namen von Strukturen</translation>
    </message>
    <message>
        <source>codes and algorithms that segmentation files gave structures</source>
        <translation>Codes und Verfahren, die Segmentierungsdateien den Strukturen gaben</translation>
    </message>
    <message>
        <source>names of meshes</source>
        <translation>Namen von Netzen</translation>
    </message>
    <message>
        <source>names of MRs, approaches and saved views</source>
        <translation>Namen von MR, Zugängen und gespeicherten Ansichten</translation>
    </message>
    <message>
        <source>names of structures that are gone, in strokes that touched them</source>
        <translation>Namen von Strukturen, die nicht mehr da sind, in Bohrzügen, die sie berührten</translation>
    </message>
    <message>
        <source>names of measurements</source>
        <translation>Namen von Messungen</translation>
    </message>
    <message>
        <source>name of the case, diagnosis and procedure</source>
        <translation>Name des Falls, Diagnose und Eingriff</translation>
    </message>
    <message>
        <source>the face, which is masked in %~1</source>
        <translation>das Gesicht, das maskiert ist in %~1</translation>
    </message>
    <message>
        <source>the face, which is masked where one is found</source>
        <translation>das Gesicht, das maskiert wird, wo eines gefunden wird</translation>
    </message>
    <message>
        <source>images, structures and meshes: the plan is restored where the very same CT is</source>
        <translation>Bilder, Strukturen und Netze: Der Plan wird dort wiederhergestellt, wo genau dasselbe CT ist</translation>
    </message>
    <message>
        <source>name, birth date, numbers and other data of the patient, hospital and physicians, dates and times: the case has none of them</source>
        <translation>Name, Geburtsdatum, Nummern und andere Angaben zu Patient, Krankenhaus und Ärzten, Daten und Zeiten: Der Fall hat nichts davon</translation>
    </message>
    <message>
        <source>as the patient '%1', ID %2: a pseudonym without the name of the case, which may be a patient's, or is not known to be none</source>
        <translation>als der Patient „%1“, ID %2: ein Pseudonym ohne den Namen des Falls, der der eines Patienten sein kann, oder von dem nicht bekannt ist, dass er es nicht ist</translation>
    </message>
    <message>
        <source>as the patient '%1', ID %2: a pseudonym with the name of the case</source>
        <translation>als Patient „%1“, ID %2: ein Pseudonym mit dem Namen des Falls</translation>
    </message>
    <message>
        <source>the name of the case as a patient's: %~1. It is within the scene</source>
        <translation>der Name des Falls als Name eines Patienten: %~1. In der Szene steht er</translation>
    </message>
    <message>
        <source>the name of the case as a patient's: %~1</source>
        <translation>der Name des Falls als Name eines Patienten: %~1</translation>
    </message>
    <message>
        <source>UIDs of the scanner's files: the objects have new ones</source>
        <translation>UIDs der Dateien des Geräts: Die Objekte haben neue</translation>
    </message>
    <message>
        <source>strokes, views and description of the case</source>
        <translation>Bohrzüge, Ansichten und Beschreibung des Falls</translation>
    </message>
    <message>
        <source>name, birth date, numbers and other data of the patient, hospital and physicians, dates and times of the scan: the case has none of them</source>
        <translation>Name, Geburtsdatum, Nummern und andere Angaben zu Patient, Krankenhaus und Ärzten, Daten und Zeiten der Aufnahme: Der Fall hat nichts davon</translation>
    </message>
    <message>
        <source>UIDs of the scanner's files: the case has none of them</source>
        <translation>UIDs der Dateien des Geräts: Der Fall hat keine davon</translation>
    </message>
    <message>
        <source>lists none of them (yet)</source>
        <translation>führt (noch) keines davon auf</translation>
    </message>
    <message>
        <source>did not answer when it was asked for them</source>
        <translation>antwortete nicht auf die Frage danach</translation>
    </message>
    <message>
        <source>offers no queries</source>
        <translation>bietet keine Abfragen</translation>
    </message>
    <message>
        <source>the name of the case is not the patient's name at node '%1': %~2</source>
        <translation>Der Name des Falls ist am Knoten „%1“ nicht der Patientenname: %~2</translation>
    </message>
    <message>
        <source>another library does not find it there by its name: it receives the study %1, of the patient ID %2</source>
        <translation>eine andere Bibliothek findet ihn dort nicht unter seinem Namen: Sie empfängt die Studie %1 mit der Patienten-ID %2</translation>
    </message>
    <message>
        <source>cases that were sent by the program's first version are not listed: %~1</source>
        <translation>Fälle, die die erste Version des Programms gesendet hat, sind nicht aufgeführt: %~1</translation>
    </message>
    <message>
        <source>node '%1': has no such study; check the UID, or ask the node's administrator whether it was deleted</source>
        <translation>Knoten „%1“: hat keine solche Studie; prüfen Sie die UID, oder fragen Sie die Administration des Knotens, ob sie gelöscht wurde</translation>
    </message>
    <message>
        <source>receive: the study has no Petrous scene; give --as NAME for the case that is built of it</source>
        <translation>Empfangen: Die Studie hat keine Szene von Petrous; geben Sie dem Fall, der daraus entsteht, einen Namen</translation>
    </message>
    <message>
        <source>receive: the study has no Petrous scene; give --as NAME for the case that is built of it (%~1)</source>
        <translation>Empfangen: Die Studie hat keine Szene von Petrous; geben Sie dem Fall, der daraus entsteht, einen Namen (%~1)</translation>
    </message>
    <message>
        <source>node '%1': the study has no CT and no MR</source>
        <translation>Knoten „%1“: Die Studie hat weder CT noch MR</translation>
    </message>
    <message>
        <source>node '%1': the study has no CT; an MR begins a case by --series UID</source>
        <translation>Knoten „%1“: Die Studie hat kein CT; wählen Sie eine MR-Serie für einen Fall damit</translation>
    </message>
    <message>
        <source>node '%1': the study has no such series</source>
        <translation>Knoten „%1“: Die Studie hat keine solche Serie</translation>
    </message>
    <message>
        <source>%#1 of %#2 instances name the patient otherwise than the first: it is in doubt whether all are of one patient; compare them at the node</source>
        <translation>%#1 von %#2 Instanzen nennen den Patienten anders als die erste: Es ist zweifelhaft, ob alle von einem Patienten sind; vergleichen Sie beim Knoten</translation>
    </message>
    <message>
        <source>axes: LPS leaves them as they are; say where what the file calls left, posterior and superior really points, such as RPS</source>
        <translation>Achsen: LPS lässt sie, wie sie sind; sagen Sie, wohin das wirklich zeigt, was die Datei links, hinten und oben nennt, etwa RPS</translation>
    </message>
    <message>
        <source>'%1' keeps its axes: whether '%2' goes with it is not known: %~3</source>
        <translation>„%1“ behält seine Achsen; ob „%2“ mitgeht, ist nicht bekannt: %~3</translation>
    </message>
    <message>
        <source>'%1' keeps its axes: %~2</source>
        <translation>„%1“ behält seine Achsen: %~2</translation>
    </message>
    <message>
        <source>lies in the space of '%1' as its file states it, and follows the correction of its axes (%2)</source>
        <translation>liegt im Raum von „%1“, wie dessen Datei ihn angibt, und folgt der Korrektur seiner Achsen (%2)</translation>
    </message>
    <message>
        <source>correcting the axes</source>
        <translation>Achsen werden korrigiert</translation>
    </message>
    <message>
        <source>the case has no MR, structure or mesh '%1' whose axes could be corrected</source>
        <translation>der Fall hat kein MR, keine Struktur und kein Netz „%1“, dessen Achsen korrigiert werden könnten</translation>
    </message>
    <message>
        <source>'%1' keeps its axes: strokes of this case record what was removed from it where it lies</source>
        <translation>„%1“ behält seine Achsen: Striche dieses Falls halten fest, was dort, wo es liegt, davon abgetragen wurde</translation>
    </message>
    <message>
        <source>%1: the %~2 would lie in %3, which is never changed; give it another place</source>
        <translation>%1: %~2 läge in %3, worin nie etwas geändert wird; wählen Sie einen anderen Ort</translation>
    </message>
    <message>
        <source>%1: is there already; name another file, or allow it to be replaced (--replace)</source>
        <translation>%1: ist schon da; nennen Sie eine andere Datei, oder erlauben Sie das Ersetzen</translation>
    </message>
    <message>
        <source>It is not known where the values of air end: those of soft tissue follow the scale of bone, and may be air</source>
        <translation>Es ist nicht bekannt, wo die Werte der Luft enden: die des Weichgewebes folgen der Skala des Knochens und können Luft sein</translation>
    </message>
    <message>
        <source>Estimated from the image's histogram: air ends at %1, and most of soft tissue is at %2</source>
        <translation>Aus dem Histogramm des Bildes geschätzt: Luft endet bei %1, und das meiste Weichgewebe liegt bei %2</translation>
    </message>
    <message>
        <source>All tissue</source>
        <translation>Alles Gewebe</translation>
    </message>
    <message>
        <source>Dark half</source>
        <translation>Dunkle Hälfte</translation>
    </message>
    <message>
        <source>Bone</source>
        <translation>Knochen</translation>
    </message>
    <message>
        <source>Temporal bone</source>
        <translation>Felsenbein</translation>
    </message>
    <message>
        <source>Soft tissue</source>
        <translation>Weichteile</translation>
    </message>
    <message>
        <source>MR '%1' is left out</source>
        <translation>das MR „%1“ ist weggelassen</translation>
    </message>
    <message>
        <source>there is no MR '%1' to leave out; the case has none</source>
        <translation>es gibt kein MR „%1“, das weggelassen werden könnte; der Fall hat keines</translation>
    </message>
    <message>
        <source>there is no MR '%1' to leave out; the case has %~2</source>
        <translation>es gibt kein MR „%1“, das weggelassen werden könnte; der Fall hat %~2</translation>
    </message>
    <message>
        <source>loading structures</source>
        <translation>Strukturen werden geladen</translation>
    </message>
    <message>
        <source>holds %#1 objects, taken as one structure; --mesh-parts gives one of each</source>
        <translation>enthält %#1 Objekte, als eine Struktur genommen; mit „Eine Struktur je Objekt“ noch einmal hinzugefügt ergibt es eine aus jedem</translation>
    </message>
    <message>
        <source>holds %#1 objects: %~2, taken as one structure; --mesh-parts gives one of each</source>
        <translation>enthält %#1 Objekte: %~2, als eine Struktur genommen; mit „Eine Struktur je Objekt“ noch einmal hinzugefügt ergibt es eine aus jedem</translation>
    </message>
    <message>
        <source>holds %#1 objects, among them %~2, taken as one structure; --mesh-parts gives one of each</source>
        <translation>enthält %#1 Objekte, darunter %~2, als eine Struktur genommen; mit „Eine Struktur je Objekt“ noch einmal hinzugefügt ergibt es eine aus jedem</translation>
    </message>
    <message>
        <source>has %#1 parts, of which %#2 is wound the other way; it counts as solid all the same</source>
        <translation>hat %#1 Teile, von denen %#2 andersherum orientiert ist; er gilt trotzdem als massiv</translation>
    </message>
    <message>
        <source>has %#1 parts, of which %#2 are wound the other way; they count as solid all the same</source>
        <translation>hat %#1 Teile, von denen %#2 andersherum orientiert sind; sie gelten trotzdem als massiv</translation>
    </message>
    <message>
        <source>has %#1 part in another that faces the other way; it counts as a cavity</source>
        <translation>hat %#1 Teil in einem anderen, der andersherum orientiert ist; er gilt als Hohlraum</translation>
    </message>
    <message>
        <source>has %#1 parts in another that face the other way; they count as cavities</source>
        <translation>hat %#1 Teile in einem anderen, die andersherum orientiert sind; sie gelten als Hohlräume</translation>
    </message>
    <message>
        <source>has %#1 part in another that faces the same way; it bounds nothing</source>
        <translation>hat %#1 Teil in einem anderen, der ebenso orientiert ist; er begrenzt nichts</translation>
    </message>
    <message>
        <source>has %#1 parts in another that face the same way; they bound nothing</source>
        <translation>hat %#1 Teile in einem anderen, die ebenso orientiert sind; sie begrenzen nichts</translation>
    </message>
    <message>
        <source>has each triangle twice; it counts once</source>
        <translation>hat jedes Dreieck doppelt; es zählt einmal</translation>
    </message>
    <message>
        <source>has %#1 triangles that are there already; they count once</source>
        <translation>hat %#1 Dreiecke, die schon vorhanden sind; sie zählen einmal</translation>
    </message>
    <message>
        <source>has parts that overlap and are wound opposite ways: where they do counts as outside; make one surface of them where it comes from</source>
        <translation>hat Teile, die sich überlappen und gegensinnig orientiert sind: wo sie sich überlappen, gilt als außen; machen Sie im Herkunftsprogramm eine Oberfläche daraus</translation>
    </message>
    <message>
        <source>has parts that overlap: the volume is that of their union</source>
        <translation>hat Teile, die sich überlappen: das Volumen ist das ihrer Vereinigung</translation>
    </message>
    <message>
        <source>as %1, as it states</source>
        <translation>als %1, wie angegeben</translation>
    </message>
    <message>
        <source>as %1 (it states the frame)</source>
        <translation>als %1 (das Bezugssystem ist angegeben)</translation>
    </message>
    <message>
        <source>as %1 (it states the unit)</source>
        <translation>als %1 (die Einheit ist angegeben)</translation>
    </message>
    <message>
        <source>state its coordinate system and unit (--mesh-frame, --mesh-unit)</source>
        <translation>geben Sie Koordinatensystem und Einheit an</translation>
    </message>
    <message>
        <source>as %1 it would reach %#2 mm beyond it</source>
        <translation>als %1 würde es %#2 mm darüber hinausreichen</translation>
    </message>
    <message>
        <source>reaches %#1 mm beyond %2</source>
        <translation>reicht %#1 mm über %2 hinaus</translation>
    </message>
    <message>
        <source>is %#1 mm large</source>
        <translation>ist %#1 mm groß</translation>
    </message>
    <message>
        <source>%1 it %~2, and in no other space would it lie inside as a whole%~3</source>
        <translation>%1 würde es %~2, und als nichts anderes läge es ganz innerhalb%~3</translation>
    </message>
    <message>
        <source>%1 it %~2, as %~3 it would lie inside%~4</source>
        <translation>%1 würde es %~2, als %~3 läge es innerhalb%~4</translation>
    </message>
    <message>
        <source>%1 it follows %#2 of the edges of %3, as %4 %#5 (by chance 50 %)%~6</source>
        <translation>%1 folgt es %#2 der Kanten von %3, als %4 %#5 (zufällig wären 50 %)%~6</translation>
    </message>
    <message>
        <source>follows %#1 of the edges of %2 as %3, and %#4 as %5, as it was taken; look whether it lies where it belongs</source>
        <translation>folgt %#1 der Kanten von %2 als %3, und %#4 als %5, wie es genommen wurde; sehen Sie nach, ob die Lage stimmt</translation>
    </message>
    <message>
        <source>does not state its coordinate system and unit, and as %1 would reach only %#2 mm beyond %3; it was taken as %4, so look whether it lies where it belongs</source>
        <translation>nennt weder Koordinatensystem noch Einheit und würde als %1 nur %#2 mm über %3 hinausreichen; genommen als %4, sehen Sie daher nach, ob die Lage stimmt</translation>
    </message>
    <message>
        <source>does not state its coordinate system and unit, and would lie inside %1 also as %2; it was taken as %3, so look whether it lies where it belongs</source>
        <translation>nennt weder Koordinatensystem noch Einheit und läge innerhalb von %1 auch als %2; genommen als %3, sehen Sie daher nach, ob die Lage stimmt</translation>
    </message>
    <message>
        <source>lies outside %1 altogether, by up to %2</source>
        <translation>liegt ganz außerhalb von %1, um bis zu %2</translation>
    </message>
    <message>
        <source>reaches %1 beyond %2; %#3 % of its surface lies outside</source>
        <translation>reicht %1 über %2 hinaus; %#3 % der Oberfläche liegen außerhalb</translation>
    </message>
    <message>
        <source>looking for structures</source>
        <translation>Strukturen werden gesucht</translation>
    </message>
    <message>
        <source>mask of a structure</source>
        <translation>Maske einer Struktur</translation>
    </message>
    <message>
        <source>segmentation of 3D Slicer</source>
        <translation>Segmentierung von 3D Slicer</translation>
    </message>
    <message>
        <source>label map</source>
        <translation>Labelkarte</translation>
    </message>
    <message>
        <source>%#1 masks, one structure a file</source>
        <translation>%#1 Masken, eine Datei je Struktur</translation>
    </message>
    <message>
        <source>%#1 meshes</source>
        <translation>%#1 Netze</translation>
    </message>
    <message>
        <source>slice %~1</source>
        <translation>Schicht %~1</translation>
    </message>
    <message>
        <source>slices %~1</source>
        <translation>Schichten %~1</translation>
    </message>
    <message>
        <source>%~1 of %#2 interpolated between neighbours</source>
        <translation>%~1 von %#2 zwischen Nachbarn interpoliert</translation>
    </message>
    <message>
        <source>gantry tilt of %#1 degrees undone, slices shifted by up to %#2 mm</source>
        <translation>Gantry-Neigung von %#1 Grad rückgängig gemacht, Schichten um bis zu %#2 mm verschoben</translation>
    </message>
    <message>
        <source>slices shifted sideways by up to %#1 mm</source>
        <translation>Schichten um bis zu %#1 mm seitlich verschoben</translation>
    </message>
    <message>
        <source>face and auricles masked</source>
        <translation>Gesicht und Ohrmuscheln maskiert</translation>
    </message>
    <message>
        <source>face masked</source>
        <translation>Gesicht maskiert</translation>
    </message>
    <message>
        <source>cropped to a region</source>
        <translation>auf einen Bereich beschnitten</translation>
    </message>
    <message>
        <source>left and right taken as RAS axes, as the file does not say which side of the patient is left</source>
        <translation>links und rechts als RAS-Achsen genommen, da die Datei nicht sagt, welche Seite des Patienten links ist</translation>
    </message>
    <message>
        <source>left and right taken as LPS axes, as the file does not say which side of the patient is left</source>
        <translation>links und rechts als LPS-Achsen genommen, da die Datei nicht sagt, welche Seite des Patienten links ist</translation>
    </message>
    <message>
        <source>left</source>
        <translation>links</translation>
    </message>
    <message>
        <source>right</source>
        <translation>rechts</translation>
    </message>
    <message>
        <source>back</source>
        <translation>hinten</translation>
    </message>
    <message>
        <source>front</source>
        <translation>vorn</translation>
    </message>
    <message>
        <source>head</source>
        <translation>Kopf</translation>
    </message>
    <message>
        <source>feet</source>
        <translation>Füße</translation>
    </message>
    <message>
        <source>axes of the file corrected (%1): what it calls left, back and head is the patient's %~2, %~3 and %~4</source>
        <translation>Achsen der Datei korrigiert (%1): Was sie links, hinten und Kopf nennt, ist beim Patienten %~2, %~3 und %~4</translation>
    </message>
    <message>
        <source>%~1 interpolated</source>
        <translation>%~1 interpoliert</translation>
    </message>
    <message>
        <source>compressed with loss, to 1/%#1 of the size</source>
        <translation>verlustbehaftet komprimiert, auf 1/%#1 der Größe</translation>
    </message>
    <message>
        <source>compressed with loss</source>
        <translation>verlustbehaftet komprimiert</translation>
    </message>
    <message>
        <source>text in the pixels</source>
        <translation>Text in den Pixeln</translation>
    </message>
    <message>
        <source>perhaps text in the pixels</source>
        <translation>vielleicht Text in den Pixeln</translation>
    </message>
    <message>
        <source>not known to be in the frame of reference of the image on which it is shown</source>
        <translation>nicht bekannt, ob im Bezugssystem des Bildes, auf dem es gezeigt wird</translation>
    </message>
    <message>
        <source>structures</source>
        <translation>Strukturen</translation>
    </message>
    <message>
        <source>Resampled from an image of which</source>
        <translation>Umgerechnet aus einem Bild, für das gilt</translation>
    </message>
    <message>
        <source>it has no transfer function of several points, and one colour would fill air too</source>
        <translation>es hat keine Transferfunktion aus mehreren Punkten, und eine einzige Farbe füllte auch Luft</translation>
    </message>
    <message>
        <source>presets are made for CT; it is drawn once it has points in values of '%1'</source>
        <translation>Vorgaben sind für CT gemacht; es wird dargestellt, sobald es Punkte in Werten von „%1“ hat</translation>
    </message>
    <message>
        <source>presets are made for CT; it is drawn once it has points in values of the MR</source>
        <translation>Vorgaben sind für CT gemacht; es wird dargestellt, sobald es Punkte in Werten des MR hat</translation>
    </message>
    <message>
        <source>'%1' is not registered with the CT</source>
        <translation>„%1“ ist nicht mit dem CT registriert</translation>
    </message>
    <message>
        <source>it is transparent at every intensity</source>
        <translation>es ist bei jeder Intensität durchsichtig</translation>
    </message>
    <message>
        <source>its values begin where soft tissue ends, at the surface threshold; it is a function of bone</source>
        <translation>ihre Werte beginnen, wo Weichteile enden, an der Oberflächenschwelle; es ist eine Funktion für Knochen</translation>
    </message>
    <message>
        <source>it reads '%1', but bone or structures read '%2' and '%3', and a picture shows two MRs</source>
        <translation>es liest „%1“, aber Knochen oder Strukturen lesen „%2“ und „%3“, und ein Bild zeigt zwei MR</translation>
    </message>
    <message>
        <source>'%1' is not drawn, and what reads it has one colour: a picture shows two MRs, '%2' and '%3'</source>
        <translation>„%1“ wird nicht dargestellt, und was es liest, ist einfarbig: ein Bild zeigt zwei MR, „%2“ und „%3“</translation>
    </message>
    <message>
        <source>says no modality</source>
        <translation>nennt keine Modalität</translation>
    </message>
    <message>
        <source>says modality %1</source>
        <translation>nennt die Modalität %1</translation>
    </message>
    <message>
        <source>RT structure set</source>
        <translation>RT-Struktursatz</translation>
    </message>
    <message>
        <source>is a DICOM segmentation</source>
        <translation>ist eine DICOM-Segmentierung</translation>
    </message>
    <message>
        <source>has a few whole numbers in patches, as labels do</source>
        <translation>hat wenige ganze Zahlen in Flecken, wie Labels</translation>
    </message>
    <message>
        <source>is in Hounsfield units</source>
        <translation>ist in Hounsfield-Einheiten</translation>
    </message>
    <message>
        <source>does not say whether it is a CT or an MR, and its numbers are no Hounsfield units</source>
        <translation>sagt nicht, ob sie ein CT oder ein MR ist, und ihre Zahlen sind keine Hounsfield-Einheiten</translation>
    </message>
    <message>
        <source>%1, volume %2</source>
        <translation>%1, Volumen %2</translation>
    </message>
    <message>
        <source>holds masks, one structure a file</source>
        <translation>enthält Masken, eine Datei je Struktur</translation>
    </message>
    <message>
        <source>is a surface of triangles</source>
        <translation>ist eine Oberfläche aus Dreiecken</translation>
    </message>
    <message>
        <source>is a DICOM RT structure set</source>
        <translation>ist ein DICOM-RT-Struktursatz</translation>
    </message>
    <message>
        <source>is a segmentation of 3D Slicer</source>
        <translation>ist eine Segmentierung von 3D Slicer</translation>
    </message>
    <message>
        <source>image</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keine</translation>
    </message>
    <message>
        <source>background</source>
        <translation>Hintergrund</translation>
    </message>
    <message>
        <source>light falloff</source>
        <translation>Lichtabfall</translation>
    </message>
    <message>
        <source>wetness</source>
        <translation>Nässe</translation>
    </message>
    <message>
        <source>exposure</source>
        <translation>Belichtung</translation>
    </message>
    <message>
        <source>edges</source>
        <translation>Kanten</translation>
    </message>
    <message>
        <source>grain</source>
        <translation>Körnung</translation>
    </message>
    <message>
        <source>shadows</source>
        <translation>Schatten</translation>
    </message>
    <message>
        <source>soft highlights</source>
        <translation>weiche Glanzlichter</translation>
    </message>
    <message>
        <source>exit surfaces</source>
        <translation>Austrittsflächen</translation>
    </message>
    <message>
        <source>stroke %#1</source>
        <translation>Bohrzug %#1</translation>
    </message>
    <message>
        <source>color</source>
        <translation>Farbe</translation>
    </message>
    <message>
        <source>transfer</source>
        <translation>Transferfunktion</translation>
    </message>
    <message>
        <source>preset</source>
        <translation>Vorgabe</translation>
    </message>
    <message>
        <source>appearance</source>
        <translation>Darstellung</translation>
    </message>
    <message>
        <source>soft tissue</source>
        <translation>Weichgewebe</translation>
    </message>
    <message>
        <source>opacity</source>
        <translation>Deckkraft</translation>
    </message>
    <message>
        <source>%#1 parts</source>
        <translation>%#1 Teile</translation>
    </message>
    <message>
        <source>show %1</source>
        <translation>%1 zeigen</translation>
    </message>
    <message>
        <source>hide %1</source>
        <translation>%1 ausblenden</translation>
    </message>
    <message>
        <source>side</source>
        <translation>Seite</translation>
    </message>
    <message>
        <source>surface threshold</source>
        <translation>Oberflächenschwelle</translation>
    </message>
    <message>
        <source>bone threshold</source>
        <translation>Knochenschwelle</translation>
    </message>
    <message>
        <source>iso</source>
        <translation>Schwelle</translation>
    </message>
    <message>
        <source>tissue</source>
        <translation>Gewebe</translation>
    </message>
    <message>
        <source>view</source>
        <translation>Ansicht</translation>
    </message>
    <message>
        <source>removal of view</source>
        <translation>Entfernen der Ansicht</translation>
    </message>
    <message>
        <source>making the tool</source>
        <translation>Werkzeug wird hergestellt</translation>
    </message>
    <message>
        <source>Another case is being opened; then the tool can be taken up.</source>
        <translation>Ein anderer Fall wird geöffnet; dann lässt sich das Werkzeug aufnehmen.</translation>
    </message>
    <message>
        <source>The case is still being prepared; then the tool can be taken up.</source>
        <translation>Der Fall wird noch vorbereitet; dann lässt sich das Werkzeug aufnehmen.</translation>
    </message>
    <message>
        <source>%1: the library keeps its own data there; name another file</source>
        <translation>%1: Dort hat die Bibliothek ihre eigenen Daten; nennen Sie eine andere Datei</translation>
    </message>
    <message>
        <source>Nothing is recorded: %~1.</source>
        <translation>Nichts wird aufgezeichnet: %~1.</translation>
    </message>
    <message>
        <source>addition of %1</source>
        <translation>Hinzufügen von %1</translation>
    </message>
    <message>
        <source>addition of %#1 parts</source>
        <translation>Hinzufügen von %#1 Teilen</translation>
    </message>
    <message>
        <source>removal of %1</source>
        <translation>Entfernen von %1</translation>
    </message>
    <message>
        <source>return of %1</source>
        <translation>Zurückholen von %1</translation>
    </message>
    <message>
        <source>what was taken out is in the case again</source>
        <translation>was herausgenommen war, ist wieder im Fall</translation>
    </message>
    <message>
        <source>'%1' cannot come back: another part has its name now; rename that one first</source>
        <translation>„%1“ kann nicht zurück: Ein anderer Teil heißt jetzt so; benennen Sie erst diesen um</translation>
    </message>
    <message>
        <source>'%1' cannot come back: the MR '%2' on which it was drawn is not in the case any more</source>
        <translation>„%1“ kann nicht zurück: Das MR „%2“, auf dem gezeichnet wurde, ist nicht mehr im Fall</translation>
    </message>
    <message>
        <source>'%1' keeps its axes: what goes with it could not be read</source>
        <translation>„%1“ behält seine Achsen: Was mitgeht, war nicht zu lesen</translation>
    </message>
    <message>
        <source>axes of %1</source>
        <translation>Achsen von %1</translation>
    </message>
    <message>
        <source>the axes stay: what was corrected was replaced since</source>
        <translation>die Achsen bleiben: Was korrigiert wurde, ist inzwischen ersetzt</translation>
    </message>
    <message>
        <source>name of %1</source>
        <translation>Name von %1</translation>
    </message>
    <message>
        <source>the case has no part '%1' that can be renamed</source>
        <translation>der Fall hat keinen Teil „%1“, der sich umbenennen lässt</translation>
    </message>
    <message>
        <source>'%1' is in the case already; take another name</source>
        <translation>„%1“ ist schon im Fall; wählen Sie einen anderen Namen</translation>
    </message>
    <message>
        <source>'%1' keeps its name: strokes of this case record under it what was removed from it</source>
        <translation>„%1“ behält den Namen: Bohrzüge dieses Falls verzeichnen darunter, was davon abgetragen wurde</translation>
    </message>
    <message>
        <source>structure '%1' is in the case already; remove it first</source>
        <translation>die Struktur „%1“ ist schon im Fall; entfernen Sie sie erst</translation>
    </message>
    <message>
        <source>change to the main approach</source>
        <translation>Wechsel zum Hauptzugang</translation>
    </message>
    <message>
        <source>change to approach %1</source>
        <translation>Wechsel zum Zugang %1</translation>
    </message>
    <message>
        <source>name of approach %1</source>
        <translation>Name des Zugangs %1</translation>
    </message>
    <message>
        <source>deletion of the main approach</source>
        <translation>Löschen des Hauptzugangs</translation>
    </message>
    <message>
        <source>deletion of approach %1</source>
        <translation>Löschen des Zugangs %1</translation>
    </message>
    <message>
        <source>The structures are still being loaded.</source>
        <translation>Die Strukturen werden noch geladen.</translation>
    </message>
    <message>
        <source>case '%1' is open in another window of Petrous, too (%~2): look at it as you like, but what is changed in both can be saved in one of them only</source>
        <translation>Der Fall „%1“ ist auch in einem anderen Fenster von Petrous geöffnet (%~2): Sie können ihn ansehen; was aber in beiden geändert wird, lässt sich nur in einem speichern</translation>
    </message>
    <message>
        <source>opening %1</source>
        <translation>%1 wird geöffnet</translation>
    </message>
    <message>
        <source>reading what was drilled</source>
        <translation>das Gebohrte wird gelesen</translation>
    </message>
    <message>
        <source>reading the CT</source>
        <translation>das CT wird gelesen</translation>
    </message>
    <message>
        <source>there is no hidapi to read a SpaceMouse with</source>
        <translation>zum Lesen einer SpaceMouse fehlt hidapi</translation>
    </message>
    <message>
        <source>the mouse is not a device that can be opened</source>
        <translation>die Maus ist kein Gerät, das sich öffnen lässt</translation>
    </message>
    <message>
        <source>'%1' cannot be a material's name: it has a to z, 0 to 9 and hyphens, at most 40</source>
        <translation>„%1“ kann kein Name eines Materials sein: Er besteht aus a bis z, 0 bis 9 und Bindestrichen, höchstens 40</translation>
    </message>
    <message>
        <source>must lie %~1, it is %#2</source>
        <translation>muss %~1 liegen, ist aber %#2</translation>
    </message>
    <message>
        <source>above 0 and at most at %#1</source>
        <translation>über 0 und höchstens bei %#1</translation>
    </message>
    <message>
        <source>above 0 GPa</source>
        <translation>über 0 GPa</translation>
    </message>
    <message>
        <source>above 0 HV</source>
        <translation>über 0 HV</translation>
    </message>
    <message>
        <source>within 0 to %#1 micrometres</source>
        <translation>in 0 bis %#1 Mikrometern</translation>
    </message>
    <message>
        <source>within -%1 to %2 degrees</source>
        <translation>zwischen -%1 und %2 Grad</translation>
    </message>
    <message>
        <source>cannot be removed</source>
        <translation>kann nicht entfernt werden</translation>
    </message>
    <message>
        <source>material '%1' has its name for good: presets give it to structures</source>
        <translation>Material „%1“ behält seinen Namen: Voreinstellungen geben es Strukturen</translation>
    </message>
    <message>
        <source>material '%1' cannot be removed: presets give it to structures</source>
        <translation>Material „%1“ kann nicht entfernt werden: Voreinstellungen geben es Strukturen</translation>
    </message>
    <message>
        <source>burr '%1' has its name for good: it is the usual one of its kind</source>
        <translation>Fräse „%1“ behält ihren Namen: Sie ist die übliche ihrer Art</translation>
    </message>
    <message>
        <source>burr '%1' cannot be removed: it is the usual one of its kind</source>
        <translation>Fräse „%1“ kann nicht entfernt werden: Sie ist die übliche ihrer Art</translation>
    </message>
    <message>
        <source>'%~1' is not a diameter: numbers above 0, up to %#2 mm</source>
        <translation>„%~1“ ist kein Durchmesser: Zahlen über 0, bis %#2 mm</translation>
    </message>
    <message>
        <source>a burr needs at least one diameter</source>
        <translation>eine Fräse braucht mindestens einen Durchmesser</translation>
    </message>
    <message>
        <source>device limits: a stiffness must be above 0, up to 20 N/mm</source>
        <translation>Grenzen des Geräts: eine Steifigkeit muss über 0 liegen, bis 20 N/mm</translation>
    </message>
    <message>
        <source>waiting for the device</source>
        <translation>es wird auf das Gerät gewartet</translation>
    </message>
    <message>
        <source>move the handle through all of its workspace, and press its buttons</source>
        <translation>führen Sie den Griff durch seinen ganzen Arbeitsraum, und drücken Sie seine Tasten</translation>
    </message>
    <message>
        <source>hold the handle lightly in the middle, and keep it still</source>
        <translation>halten Sie den Griff locker in der Mitte, und halten Sie ihn ruhig</translation>
    </message>
    <message>
        <source>hold it lightly: a short push along %1</source>
        <translation>halten Sie ihn locker: ein kurzer Stoß entlang %1</translation>
    </message>
    <message>
        <source>hold it lightly: spring along %1, %#2 N/mm</source>
        <translation>halten Sie ihn locker: Feder entlang %1, %#2 N/mm</translation>
    </message>
    <message>
        <source>an instrument lies along x+, x-, y+, y-, z+ or z- of its file, not along '%1'</source>
        <translation>ein Instrument liegt entlang x+, x-, y+, y-, z+ oder z- seiner Datei, nicht entlang „%1“</translation>
    </message>
    <message>
        <source>it would be %#1 mm if its numbers were in %~2</source>
        <translation>es wären %#1 mm, wenn die Zahlen in %~2 wären</translation>
    </message>
    <message>
        <source>%#1 mm if its numbers were in %~2</source>
        <translation>%#1 mm, wenn die Zahlen in %~2 wären</translation>
    </message>
    <message>
        <source>is %#1 mm long by the unit that it states, and an instrument is 1 to 300 mm%~2; export it in mm</source>
        <translation>ist nach der angegebenen Einheit %#1 mm lang, und ein Instrument 1 bis 300 mm%~2; exportieren Sie es in mm</translation>
    </message>
    <message>
        <source>is %#1 mm long, and an instrument is 1 to 300 mm%~2; export it in mm</source>
        <translation>ist %#1 mm lang, und ein Instrument 1 bis 300 mm%~2; exportieren Sie es in mm</translation>
    </message>
    <message>
        <source>has %#1 triangles, and an instrument at most %#2; export it coarser</source>
        <translation>hat %#1 Dreiecke, und ein Instrument höchstens %#2; exportieren Sie es gröber</translation>
    </message>
    <message>
        <source>is not closed: its surface ends at %#1 edges; an instrument is a solid body, so close its holes and export it again</source>
        <translation>ist nicht geschlossen: Die Oberfläche endet an %#1 Kanten; ein Instrument ist ein fester Körper: Schließen Sie die Löcher, und exportieren Sie es noch einmal</translation>
    </message>
    <message>
        <source>encloses nothing; an instrument is a solid body with a closed surface</source>
        <translation>umschließt nichts; ein Instrument ist ein fester Körper mit geschlossener Oberfläche</translation>
    </message>
    <message>
        <source>Its tip is taken to be the point farthest from the hand, as the file's origin is not within 1 mm of its surface</source>
        <translation>Als Spitze gilt der Punkt, der am weitesten von der Hand entfernt ist, denn der Ursprung der Datei liegt mehr als 1 mm von der Oberfläche entfernt</translation>
    </message>
    <message>
        <source>Its tip is taken to be the point farthest from the hand, as the file's origin lies at the other end; if the tip is at the origin, its axis is %1 instead of %2</source>
        <translation>Als Spitze gilt der Punkt, der am weitesten von der Hand entfernt ist, denn der Ursprung der Datei liegt am anderen Ende; ist die Spitze am Ursprung, so ist die Achse %1 statt %2</translation>
    </message>
    <message>
        <source>Its tip is taken to be the point farthest from the hand, as it reaches %#1 mm beyond the file's origin</source>
        <translation>Als Spitze gilt der Punkt, der am weitesten von der Hand entfernt ist, denn das Instrument reicht %#1 mm über den Ursprung der Datei hinaus</translation>
    </message>
    <message>
        <source>It is longer across the shaft than along it; if it lies along another axis of its file than %1, say which</source>
        <translation>Es ist quer zum Schaft länger als längs; falls es entlang einer anderen Achse seiner Datei als %1 liegt, geben Sie diese an</translation>
    </message>
    <message>
        <source>sampling the instrument</source>
        <translation>Das Instrument wird abgetastet</translation>
    </message>
    <message>
        <source>%1: %#2 points, no place within 10 mm of its tip farther than %#3 mm from one, and none at all farther than %#4 mm; bone thinner than twice that may pass between them unfelt</source>
        <translation>%1: %#2 Punkte, keine Stelle bis 10 mm von der Spitze weiter als %#3 mm von einem entfernt und überhaupt keine weiter als %#4 mm; Knochen, der dünner als das Doppelte ist, kann ungefühlt zwischen ihnen hindurchgehen</translation>
    </message>
    <message>
        <source>there is no recording to be read</source>
        <translation>es ist keine Aufzeichnung zu lesen</translation>
    </message>
    <message>
        <source>%#1 stroke</source>
        <translation>%#1 Bohrzug</translation>
    </message>
    <message>
        <source>%#1 strokes</source>
        <translation>%#1 Bohrzüge</translation>
    </message>
    <message>
        <source>take back what came after: petrous undo '%1' %#2</source>
        <translation>nehmen Sie zurück, was danach kam (Fall „%1“, %#2)</translation>
    </message>
    <message>
        <source>bring back what was there: petrous redo '%1' %#2</source>
        <translation>holen Sie zurück, was da war (Fall „%1“, %#2)</translation>
    </message>
    <message>
        <source>was recorded by another version of this program, whose tool had other points</source>
        <translation>wurde mit einer anderen Version dieses Programms aufgezeichnet, deren Werkzeug andere Punkte hatte</translation>
    </message>
    <message>
        <source>was recorded on another %~1 than that of '%2'</source>
        <translation>wurde auf einem anderen %~1 aufgezeichnet als dem von „%2“</translation>
    </message>
    <message>
        <source>was recorded with tissue from %~1 on, '%2' has it from %~3 on: petrous appearance '%4' --iso %5</source>
        <translation>wurde mit Gewebe ab %~1 aufgezeichnet, „%2“ hat es ab %~3: Oberflächenschwelle von „%4“ auf %5 stellen</translation>
    </message>
    <message>
        <source>was recorded with bone from %~1 on, '%2' has it from %~3 on: petrous appearance '%4' --iso %5</source>
        <translation>wurde mit Knochen ab %~1 aufgezeichnet, „%2“ hat ihn ab %~3: Knochenschwelle von „%4“ auf %5 stellen</translation>
    </message>
    <message>
        <source>was recorded with other structures under hand and drill than '%1' has; see what is touchable and drillable: petrous appearance '%2' --list</source>
        <translation>wurde mit anderen fühlbaren und bohrbaren Strukturen aufgezeichnet, als „%1“ hat; sehen Sie bei „%2“ nach, was fühlbar und bohrbar ist</translation>
    </message>
    <message>
        <source>began on another dissection (%1) than '%2' has (%3)%4</source>
        <translation>begann auf einem anderen Präparat (%1), als „%2“ hat (%3)%4</translation>
    </message>
    <message>
        <source>recording: a tool of %#1 degrees of freedom; this program has tools of 3 and of 6</source>
        <translation>Aufzeichnung: ein Werkzeug mit %#1 Freiheitsgraden; dieses Programm hat Werkzeuge mit 3 und mit 6</translation>
    </message>
    <message>
        <source>%1: cannot be made (no permission or a full disk); choose another place for the recording</source>
        <translation>%1: lässt sich nicht anlegen (keine Berechtigung oder Datenträger voll); wählen Sie einen anderen Ort für die Aufzeichnung</translation>
    </message>
    <message>
        <source>comparing the case with the recording</source>
        <translation>der Fall wird mit der Aufzeichnung verglichen</translation>
    </message>
    <message>
        <source>redoes an older stroke, and does not tell which</source>
        <translation>wiederholt einen älteren Bohrzug und sagt nicht, welchen</translation>
    </message>
    <message>
        <source>redoes an older stroke that this case does not have</source>
        <translation>wiederholt einen älteren Bohrzug, den dieser Fall nicht hat</translation>
    </message>
    <message>
        <source>playing the recording</source>
        <translation>die Aufzeichnung wird abgespielt</translation>
    </message>
    <message>
        <source>cuts another dissection here than where it was made</source>
        <translation>ergibt hier ein anderes Präparat als dort, wo sie gemacht wurde</translation>
    </message>
    <message>
        <source>measuring the structures</source>
        <translation>die Strukturen werden gemessen</translation>
    </message>
    <message>
        <source>recording</source>
        <translation>Aufzeichnung</translation>
    </message>
    <message>
        <source>nerve</source>
        <translation>Nerv</translation>
    </message>
    <message>
        <source>show what was shown before</source>
        <translation>zeigen, was vorher gezeigt wurde</translation>
    </message>
    <message>
        <source>only bone</source>
        <translation>nur Knochen</translation>
    </message>
    <message>
        <source>only soft tissue</source>
        <translation>nur Weichgewebe</translation>
    </message>
    <message>
        <source>only %1</source>
        <translation>nur %1</translation>
    </message>
    <message>
        <source>only %#1 parts</source>
        <translation>nur %#1 Teile</translation>
    </message>
    <message>
        <source>None</source>
        <translation>Keines</translation>
    </message>
    <message>
        <source>Mark</source>
        <translation>Marke</translation>
    </message>
    <message>
        <source>Distance</source>
        <translation>Abstand</translation>
    </message>
    <message>
        <source>Along a structure</source>
        <translation>Entlang einer Struktur</translation>
    </message>
    <message>
        <source>Angle</source>
        <translation>Winkel</translation>
    </message>
    <message>
        <source>Area</source>
        <translation>Fläche</translation>
    </message>
    <message>
        <source>Wall thickness</source>
        <translation>Wanddicke</translation>
    </message>
    <message>
        <source>The centre line is being computed; another click goes on with a line of your own.</source>
        <translation>Die Mittellinie wird berechnet; ein weiterer Klick setzt eine eigene Linie fort.</translation>
    </message>
    <message>
        <source>It is being measured.</source>
        <translation>Es wird gemessen.</translation>
    </message>
    <message>
        <source>Click a place in a slice, or on the surface in the 3D view.</source>
        <translation>Klicken Sie auf eine Stelle in einer Schicht oder auf der Oberfläche in der 3D-Ansicht.</translation>
    </message>
    <message>
        <source>Click the first point, or drag from it to the second.</source>
        <translation>Klicken Sie auf den ersten Punkt, oder ziehen Sie von ihm zum zweiten.</translation>
    </message>
    <message>
        <source>Click the second point.</source>
        <translation>Klicken Sie auf den zweiten Punkt.</translation>
    </message>
    <message>
        <source>Click where it begins: in a nerve or canal of the case, or anywhere.</source>
        <translation>Klicken Sie auf den Anfang: in einem Nerv oder Kanal des Falls, oder irgendwo.</translation>
    </message>
    <message>
        <source>Click where it ends in the same structure, or the next point of a line of your own.</source>
        <translation>Klicken Sie auf das Ende in derselben Struktur oder auf den nächsten Punkt einer eigenen Linie.</translation>
    </message>
    <message>
        <source>%1Click the next point; Return or a double click ends the line.</source>
        <translation>%1Klicken Sie auf den nächsten Punkt; die Eingabetaste oder ein Doppelklick beendet die Linie.</translation>
    </message>
    <message>
        <source>Click a point on the first leg.</source>
        <translation>Klicken Sie auf einen Punkt des ersten Schenkels.</translation>
    </message>
    <message>
        <source>Click the vertex.</source>
        <translation>Klicken Sie auf den Scheitel.</translation>
    </message>
    <message>
        <source>Click a point on the second leg.</source>
        <translation>Klicken Sie auf einen Punkt des zweiten Schenkels.</translation>
    </message>
    <message>
        <source>Click the first corner.</source>
        <translation>Klicken Sie auf die erste Ecke.</translation>
    </message>
    <message>
        <source>Click the next corner.</source>
        <translation>Klicken Sie auf die nächste Ecke.</translation>
    </message>
    <message>
        <source>Click the next corner; Return or a double click closes the polygon.</source>
        <translation>Klicken Sie auf die nächste Ecke; die Eingabetaste oder ein Doppelklick schließt das Vieleck.</translation>
    </message>
    <message>
        <source>Click the surface of the wall.</source>
        <translation>Klicken Sie auf die Oberfläche der Wand.</translation>
    </message>
    <message>
        <source>The case is still being prepared; then walls can be measured.</source>
        <translation>Der Fall wird noch vorbereitet; dann lassen sich Wände messen.</translation>
    </message>
    <message>
        <source>There is no surface within 3 mm; click on one.</source>
        <translation>Innerhalb von 3 mm ist keine Oberfläche; klicken Sie auf eine.</translation>
    </message>
    <message>
        <source>The wall is thicker than 30 mm here: nothing lies behind it.</source>
        <translation>Die Wand ist hier dicker als 30 mm: Dahinter liegt nichts.</translation>
    </message>
    <message>
        <source>length</source>
        <translation>Länge</translation>
    </message>
    <message>
        <source>it encloses nothing</source>
        <translation>sie umschließt nichts</translation>
    </message>
    <message>
        <source>centre line</source>
        <translation>Mittellinie</translation>
    </message>
    <message>
        <source>'%1' has no centre line: %~2.</source>
        <translation>„%1“ hat keine Mittellinie: %~2.</translation>
    </message>
    <message>
        <source>length of %1</source>
        <translation>Länge von %1</translation>
    </message>
    <message>
        <source>bone over %1</source>
        <translation>Knochen über %1</translation>
    </message>
    <message>
        <source>move %~1</source>
        <translation>%~1 verschieben</translation>
    </message>
    <message>
        <source>rename '%1'</source>
        <translation>„%1“ umbenennen</translation>
    </message>
    <message>
        <source>remove %~1</source>
        <translation>%~1 entfernen</translation>
    </message>
    <message>
        <source>show %~1</source>
        <translation>%~1 zeigen</translation>
    </message>
    <message>
        <source>hide %~1</source>
        <translation>%~1 ausblenden</translation>
    </message>
    <message>
        <source>show all measurements</source>
        <translation>alle Messungen zeigen</translation>
    </message>
    <message>
        <source>hide all measurements</source>
        <translation>alle Messungen ausblenden</translation>
    </message>
    <message>
        <source>the last point</source>
        <translation>den letzten Punkt</translation>
    </message>
    <message>
        <source>comparing approaches</source>
        <translation>Zugänge werden verglichen</translation>
    </message>
    <message>
        <source>measuring distances</source>
        <translation>Abstände werden gemessen</translation>
    </message>
    <message>
        <source>difference %#1</source>
        <translation>Unterschied %#1</translation>
    </message>
    <message>
        <source>drawing strokes</source>
        <translation>Bohrzüge werden gezeichnet</translation>
    </message>
    <message>
        <source>thickness</source>
        <translation>Dicke</translation>
    </message>
    <message>
        <source>thickness: '%1' encloses nothing</source>
        <translation>Dicke: „%1“ umschließt nichts</translation>
    </message>
    <message>
        <source>distances: the dissection of case '%1' is not loaded</source>
        <translation>Abstände: Das Präparat des Falls „%1“ ist nicht geladen</translation>
    </message>
    <message>
        <source>distance of the dissection</source>
        <translation>Abstand der Präparation</translation>
    </message>
    <message>
        <source>set on the MR '%1', which is gone</source>
        <translation>gesetzt auf dem MR „%1“, das nicht mehr da ist</translation>
    </message>
    <message>
        <source>set on the %~1, voxels %#2 x %#3 x %#4 mm</source>
        <translation>gesetzt auf dem %~1, Voxel %#2 x %#3 x %#4 mm</translation>
    </message>
    <message>
        <source>set on the MR '%1', voxels %#2 x %#3 x %#4 mm</source>
        <translation>gesetzt auf dem MR „%1“, Voxel %#2 x %#3 x %#4 mm</translation>
    </message>
    <message>
        <source>set on the</source>
        <translation>gesetzt auf dem</translation>
    </message>
    <message>
        <source>its registration's error unknown</source>
        <translation>Fehler der Registrierung unbekannt</translation>
    </message>
    <message>
        <source>points</source>
        <translation>Punkte</translation>
    </message>
    <message>
        <source>point</source>
        <translation>Punkt</translation>
    </message>
    <message>
        <source>position</source>
        <translation>Lage</translation>
    </message>
    <message>
        <source>thickness along the normal</source>
        <translation>Dicke entlang der Normalen</translation>
    </message>
    <message>
        <source>which was drawn on the MR '%1'</source>
        <translation>das auf dem MR „%1“ gezeichnet wurde</translation>
    </message>
    <message>
        <source>which was made from the MR %1</source>
        <translation>das aus dem MR %1 gemacht wurde</translation>
    </message>
    <message>
        <source>%~1, uncertainty unknown</source>
        <translation>%~1, Unsicherheit unbekannt</translation>
    </message>
    <message>
        <source>along the centre line of '%1'</source>
        <translation>entlang der Mittellinie von „%1“</translation>
    </message>
    <message>
        <source>along the centre line of '%1', which was removed or moved since</source>
        <translation>entlang der Mittellinie von „%1“, seither entfernt oder verschoben</translation>
    </message>
    <message>
        <source>along the centre line of '%1', which was removed</source>
        <translation>entlang der Mittellinie von „%1“, das entfernt wurde</translation>
    </message>
    <message>
        <source>its edges cross, so it has no area</source>
        <translation>die Kanten kreuzen sich, daher ohne Fläche</translation>
    </message>
    <message>
        <source>points up to %#1 mm off its plane</source>
        <translation>Punkte bis zu %#1 mm neben ihrer Ebene</translation>
    </message>
    <message>
        <source>its points coincide</source>
        <translation>die Punkte fallen zusammen</translation>
    </message>
    <message>
        <source>to '%1'</source>
        <translation>zu „%1“</translation>
    </message>
    <message>
        <source>to '%1', which was removed or moved since</source>
        <translation>zu „%1“, seither entfernt oder verschoben</translation>
    </message>
    <message>
        <source>to '%1', which was removed</source>
        <translation>zu „%1“, das entfernt wurde</translation>
    </message>
    <message>
        <source>shortest thickness</source>
        <translation>kürzeste Dicke</translation>
    </message>
    <message>
        <source>%~1 mm ± %#2</source>
        <translation>%~1 mm ± %#2</translation>
    </message>
    <message>
        <source>%~1 mm, uncertainty unknown</source>
        <translation>%~1 mm, Unsicherheit unbekannt</translation>
    </message>
    <message>
        <source>volume</source>
        <translation>Volumen</translation>
    </message>
    <message>
        <source>of its voxels</source>
        <translation>der Voxel</translation>
    </message>
    <message>
        <source>drilled</source>
        <translation>gebohrt</translation>
    </message>
    <message>
        <source>removed by the strokes that are applied</source>
        <translation>abgetragen durch die ausgeführten Bohrzüge</translation>
    </message>
    <message>
        <source>dimensions</source>
        <translation>Maße</translation>
    </message>
    <message>
        <source>dimensions: '%1' encloses nothing</source>
        <translation>Maße: „%1“ umschließt nichts</translation>
    </message>
    <message>
        <source>its surface is open</source>
        <translation>die Oberfläche ist offen</translation>
    </message>
    <message>
        <source>if its whole surface lay half a voxel farther out or in; %~1</source>
        <translation>wenn die ganze Oberfläche ein halbes Voxel weiter außen oder innen läge; %~1</translation>
    </message>
    <message>
        <source>longest extent</source>
        <translation>größte Ausdehnung</translation>
    </message>
    <message>
        <source>second extent</source>
        <translation>zweite Ausdehnung</translation>
    </message>
    <message>
        <source>third extent</source>
        <translation>dritte Ausdehnung</translation>
    </message>
    <message>
        <source>along a principal axis of inertia, direction %#1, %#2, %#3 (LPS)</source>
        <translation>entlang einer Hauptträgheitsachse, Richtung %#1, %#2, %#3 (LPS)</translation>
    </message>
    <message>
        <source>largest thickness</source>
        <translation>größte Dicke</translation>
    </message>
    <message>
        <source>of the largest ball that fits inside</source>
        <translation>der größten Kugel, die hineinpasst</translation>
    </message>
    <message>
        <source>length of the centre line</source>
        <translation>Länge der Mittellinie</translation>
    </message>
    <message>
        <source>of the circle with the area of the cross-section</source>
        <translation>des Kreises mit der Fläche des Querschnitts</translation>
    </message>
    <message>
        <source>smallest diameter</source>
        <translation>kleinster Durchmesser</translation>
    </message>
    <message>
        <source>median diameter</source>
        <translation>medianer Durchmesser</translation>
    </message>
    <message>
        <source>largest diameter</source>
        <translation>größter Durchmesser</translation>
    </message>
    <message>
        <source>length: '%1' has no centre line: %~2</source>
        <translation>Länge: „%1“ hat keine Mittellinie: %~2</translation>
    </message>
    <message>
        <source>as it lay before</source>
        <translation>wie es vorher lag</translation>
    </message>
    <message>
        <source>distance</source>
        <translation>Abstand</translation>
    </message>
    <message>
        <source>distance: '%1' encloses nothing</source>
        <translation>Abstand: „%1“ umschließt nichts</translation>
    </message>
    <message>
        <source>%1 as it lay before</source>
        <translation>%1, wie es vorher lag</translation>
    </message>
    <message>
        <source>shortest distance</source>
        <translation>kürzester Abstand</translation>
    </message>
    <message>
        <source>distance: '%1' has no surface</source>
        <translation>Abstand: „%1“ hat keine Oberfläche</translation>
    </message>
    <message>
        <source>mark %1</source>
        <translation>Marke %1</translation>
    </message>
    <message>
        <source>they touch or overlap</source>
        <translation>sie berühren oder überlappen sich</translation>
    </message>
    <message>
        <source>%~1: '%2' is nowhere on the %~3: %~4</source>
        <translation>%~1: „%2“ liegt nirgends auf dem %~3: %~4</translation>
    </message>
    <message>
        <source>%~1: case '%2' has no structures</source>
        <translation>%~1: Der Fall „%2“ hat keine Strukturen</translation>
    </message>
    <message>
        <source>%~1: case '%2' has no structure '%3' with voxels; it has %4</source>
        <translation>%~1: Der Fall „%2“ hat keine Struktur „%3“ mit Voxeln; er hat %4</translation>
    </message>
    <message>
        <source>and %#1 more</source>
        <translation>und %#1 weitere</translation>
    </message>
    <message>
        <source>touched (± %1 mm)</source>
        <translation>berührt (± %1 mm)</translation>
    </message>
    <message>
        <source>%#1 mm ± %2</source>
        <translation>%#1 mm ± %2</translation>
    </message>
    <message>
        <source>registration's error unknown</source>
        <translation>Fehler der Registrierung unbekannt</translation>
    </message>
    <message>
        <source>registration %#1 mm (p95)</source>
        <translation>Registrierung %#1 mm (p95)</translation>
    </message>
    <message>
        <source>registration %#1 mm (p95), but %#2 mm from here</source>
        <translation>Registrierung %#1 mm (p95), aber %#2 mm von hier</translation>
    </message>
    <message>
        <source>injured, %1</source>
        <translation>verletzt, %1</translation>
    </message>
    <message>
        <source>no warnings of %~1 yet: still being measured</source>
        <translation>noch keine Warnungen vor %~1: wird noch vermessen</translation>
    </message>
    <message>
        <source>no warnings of %~1: cannot be measured</source>
        <translation>keine Warnungen vor %~1: lässt sich nicht vermessen</translation>
    </message>
    <message>
        <source>wall</source>
        <translation>Wand</translation>
    </message>
    <message>
        <source>it is no tube: too short for its width</source>
        <translation>es ist keine Röhre: zu kurz für die Breite</translation>
    </message>
    <message>
        <source>it closes to a ring, or has a hole from side to side, so that no single line leads through it</source>
        <translation>es schließt sich zum Ring oder hat ein Loch von Seite zu Seite, sodass keine einzelne Linie hindurchführt</translation>
    </message>
    <message>
        <source>its middle lies outside of it, as it is hollow or folded</source>
        <translation>die Mitte liegt außerhalb, da es hohl oder gefaltet ist</translation>
    </message>
    <message>
        <source>distance of structures</source>
        <translation>Abstand von Strukturen</translation>
    </message>
    <message>
        <source>measuring structures</source>
        <translation>Strukturen werden vermessen</translation>
    </message>
    <message>
        <source>registered to %#1 mm (p95) here</source>
        <translation>registriert auf %#1 mm (p95) hier</translation>
    </message>
    <message>
        <source>registered to %#1 mm (p95) %~2, %#3 mm from here, where it may be more</source>
        <translation>registriert auf %#1 mm (p95) %~2, %#3 mm von hier, wo es mehr sein kann</translation>
    </message>
    <message>
        <source>voxels %#1 x %#2 x %#3 mm, slices %#4 mm apart</source>
        <translation>Voxel %#1 x %#2 x %#3 mm, Schichtabstand %#4 mm</translation>
    </message>
    <message>
        <source>drawn on the MR '%1'</source>
        <translation>gezeichnet auf dem MR „%1“</translation>
    </message>
    <message>
        <source>made from the MR %1</source>
        <translation>aus dem MR %1 gemacht</translation>
    </message>
    <message>
        <source>%~1, registered, its error unknown</source>
        <translation>%~1, registriert, Fehler unbekannt</translation>
    </message>
    <message>
        <source>case '%1' has no MR '%2'; it has none</source>
        <translation>der Fall „%1“ hat kein MR „%2“; er hat keines</translation>
    </message>
    <message>
        <source>case '%1' has no MR '%2'; it has %3</source>
        <translation>der Fall „%1“ hat kein MR „%2“; er hat %3</translation>
    </message>
    <message>
        <source>MR '%1' cannot be registered to itself</source>
        <translation>das MR „%1“ lässt sich nicht auf sich selbst registrieren</translation>
    </message>
    <message>
        <source>MR '%1' is not registered with the CT; register it first</source>
        <translation>das MR „%1“ ist nicht mit dem CT registriert; registrieren Sie es erst</translation>
    </message>
    <message>
        <source>The %#1 landmarks agree to %#2 (root mean square; pair %#3 least, %#4).</source>
        <translation>Die %#1 Landmarken stimmen auf %#2 überein (quadratisches Mittel; am wenigsten Paar %#3, %#4).</translation>
    </message>
    <message>
        <source>where the landmarks put it</source>
        <translation>wo die Landmarken es hinlegen</translation>
    </message>
    <message>
        <source>where the common frame of reference puts it</source>
        <translation>wo das gemeinsame Bezugssystem es hinlegt</translation>
    </message>
    <message>
        <source>where it lay</source>
        <translation>wo es lag</translation>
    </message>
    <message>
        <source>where it was put by hand</source>
        <translation>wo es von Hand hingelegt wurde</translation>
    </message>
    <message>
        <source>The fit lies %#1 from %~2, at %~3</source>
        <translation>Die Anpassung liegt %#1 neben der Lage, %~2, bei %~3</translation>
    </message>
    <message>
        <source>which is more than the fit's error (at most %#1): the patient moved between the two images, or one of them misleads</source>
        <translation>mehr als der Fehler der Anpassung (höchstens %#1): Der Patient bewegte sich zwischen den beiden Bildern, oder eines von beiden täuscht</translation>
    </message>
    <message>
        <source>How well '%1' lies on the CT is not known, so the error is not either.</source>
        <translation>Wie gut „%1“ auf dem CT liegt, ist nicht bekannt, der Fehler daher auch nicht.</translation>
    </message>
    <message>
        <source>The error is that of both ways: to '%1', and from there to the CT (%#2 (p95) %~3).</source>
        <translation>Der Fehler ist der beider Wege: zu „%1“ und von dort zum CT (%#2 (p95) %~3).</translation>
    </message>
    <message>
        <source>That '%1' lies right on the CT is not sure.</source>
        <translation>Dass „%1“ richtig auf dem CT liegt, ist nicht sicher.</translation>
    </message>
    <message>
        <source>MR '%1' cannot be laid as it is: it has no frame of reference in common with the CT, and neither landmarks nor a transform are given</source>
        <translation>das MR „%1“ lässt sich nicht hinlegen, wie es ist: Es hat kein gemeinsames Bezugssystem mit dem CT, und weder Landmarken noch eine Transformation sind gegeben</translation>
    </message>
    <message>
        <source>MR '%1' cannot be laid as it is: it has no frame of reference in common with '%2', and neither landmarks nor a transform are given</source>
        <translation>das MR „%1“ lässt sich nicht hinlegen, wie es ist: Es hat kein gemeinsames Bezugssystem mit „%2“, und weder Landmarken noch eine Transformation sind gegeben</translation>
    </message>
    <message>
        <source>the CT</source>
        <translation>das CT</translation>
    </message>
    <message>
        <source>It lies %~1, without a fit: its error is not known.</source>
        <translation>Es liegt, %~1, ohne Anpassung: Sein Fehler ist nicht bekannt.</translation>
    </message>
    <message>
        <source>reading the images</source>
        <translation>die Bilder werden gelesen</translation>
    </message>
    <message>
        <source>resampling the MR</source>
        <translation>das MR wird umgerechnet</translation>
    </message>
    <message>
        <source>it does not stand out from the noise</source>
        <translation>sie hebt sich nicht vom Rauschen ab</translation>
    </message>
    <message>
        <source>it is narrower than two voxels</source>
        <translation>sie ist schmaler als zwei Voxel</translation>
    </message>
    <message>
        <source>what is seen is wider than the structure can be</source>
        <translation>was zu sehen ist, ist breiter, als die Struktur sein kann</translation>
    </message>
    <message>
        <source>the path runs through air or bone, not through a nerve</source>
        <translation>der Verlauf geht durch Luft oder Knochen, nicht durch einen Nerv</translation>
    </message>
    <message>
        <source>the path leads through something of another intensity</source>
        <translation>der Verlauf führt durch etwas von anderer Intensität</translation>
    </message>
    <message>
        <source>a quarter of its circumference or more has no wall, as at an edge</source>
        <translation>ein Viertel ihres Umfangs oder mehr hat keine Wand, wie an einer Kante</translation>
    </message>
    <message>
        <source>the path is a long detour between two points; set another one between them</source>
        <translation>der Verlauf ist ein langer Umweg zwischen zwei Punkten; setzen Sie einen weiteren dazwischen</translation>
    </message>
    <message>
        <source>what is seen is too short a piece of it</source>
        <translation>was zu sehen ist, ist ein zu kurzes Stück davon</translation>
    </message>
    <message>
        <source>Not resolved from %#1 to %#2 mm: %~3.</source>
        <translation>Nicht aufgelöst von %#1 bis %#2 mm: %~3.</translation>
    </message>
    <message>
        <source>Its radius of %#1 mm is the usual one of its name, and nothing that the image shows.</source>
        <translation>Ihr Radius von %#1 mm ist der zu ihrem Namen übliche; das Bild zeigt ihn nicht.</translation>
    </message>
    <message>
        <source>where it is thinner than the voxels it is drawn one voxel wide, so that it has no gap: %#1 of its %#2 voxels, which its volume counts whole</source>
        <translation>wo sie dünner als die Voxel ist, wird sie ein Voxel breit gezeichnet, damit sie keine Lücke hat: %#1 ihrer %#2 Voxel, die ihr Volumen ganz zählt</translation>
    </message>
    <message>
        <source>tympanic cavity</source>
        <translation>Paukenhöhle</translation>
    </message>
    <message>
        <source>middle ear</source>
        <translation>Mittelohr</translation>
    </message>
    <message>
        <source>%1 is outside the %~2, whose middle is %3</source>
        <translation>%1 liegt außerhalb: %~2, dessen Mitte bei %3 liegt</translation>
    </message>
    <message>
        <source>the middle of '%1'</source>
        <translation>die Mitte von „%1“</translation>
    </message>
    <message>
        <source>'%1' is nowhere on the %~2: %~3</source>
        <translation>„%1“ liegt nirgends auf dem %~2: %~3</translation>
    </message>
    <message>
        <source>case '%1' has no structure '%2'; it has none</source>
        <translation>der Fall „%1“ hat keine Struktur „%2“; er hat keine</translation>
    </message>
    <message>
        <source>case '%1' has no structure '%2'; it has %3</source>
        <translation>der Fall „%1“ hat keine Struktur „%2“; er hat %3</translation>
    </message>
    <message>
        <source>the centre of the %~1</source>
        <translation>die Mitte des %~1</translation>
    </message>
    <message>
        <source>the centre of what both images show</source>
        <translation>die Mitte dessen, was beide Bilder zeigen</translation>
    </message>
    <message>
        <source>the axes of an MR were corrected while it was registered: the MR lies as before; register it again</source>
        <translation>die Achsen eines MR wurden korrigiert, während es registriert wurde: Das MR liegt wie zuvor; registrieren Sie es noch einmal</translation>
    </message>
    <message>
        <source>move of %1</source>
        <translation>Bewegung von %1</translation>
    </message>
    <message>
        <source>the case has no ossicle, tympanic cavity or inner ear on the %~1, so that the error is stated at the centre of the images, which may be far from the ear; put the crosshair in the middle ear and choose it here, or choose a structure</source>
        <translation>der Fall hat kein Gehörknöchelchen, keine Paukenhöhle und kein Innenohr auf dem %~1, daher wird der Fehler in der Mitte der Bilder angegeben, die weit vom Ohr entfernt sein kann; setzen Sie das Fadenkreuz ins Mittelohr und wählen Sie es hier, oder wählen Sie eine Struktur</translation>
    </message>
    <message>
        <source>registration of %1</source>
        <translation>Registrierung von %1</translation>
    </message>
    <message>
        <source>stopped before its end</source>
        <translation>vor dem Ende abgebrochen</translation>
    </message>
    <message>
        <source>removal of the registration of %1</source>
        <translation>Lösen der Registrierung von %1</translation>
    </message>
    <message>
        <source>The seed at %1 lies on a border of tissues of about %2 and %~3, and a range around it may be neither's; set it inside the structure.</source>
        <translation>Der Startpunkt bei %1 liegt auf einer Grenze von Geweben von etwa %2 und %~3, und ein Bereich um ihn ist vielleicht der von keinem; setzen Sie ihn in die Struktur.</translation>
    </message>
    <message>
        <source>The seed at %1 lies on a border of tissues of about %2 and %~3, and a range around it may be neither's; %~4 lies inside.</source>
        <translation>Der Startpunkt bei %1 liegt auf einer Grenze von Geweben von etwa %2 und %~3, und ein Bereich um ihn ist vielleicht der von keinem; %~4 liegt innen.</translation>
    </message>
    <message>
        <source>The range of %#1 to %~2 reaches from air to bone: it is that of no tissue.</source>
        <translation>Der Bereich von %#1 bis %~2 reicht von Luft bis Knochen: Er ist der keines Gewebes.</translation>
    </message>
    <message>
        <source>The region has %#1 cm³, and hardly a structure of the skull base more than %#2 cm³: it may have run into what surrounds it.</source>
        <translation>Die Region hat %#1 cm³, und kaum eine Struktur der Schädelbasis mehr als %#2 cm³: Sie ist vielleicht in ihre Umgebung gelaufen.</translation>
    </message>
    <message>
        <source>The region reaches %#1 of the 6 faces of the image: it may have run into what surrounds it.</source>
        <translation>Die Region reicht an %#1 der 6 Seiten des Bildes: Sie ist vielleicht in ihre Umgebung gelaufen.</translation>
    </message>
    <message>
        <source>Nothing was done: the slices do not show the image that this tool reads.</source>
        <translation>Nichts geschah: Die Schichten zeigen das Bild nicht, das dieses Werkzeug liest.</translation>
    </message>
    <message>
        <source>Click the next point along the nerve.</source>
        <translation>Klicken Sie auf den nächsten Punkt entlang des Nervs.</translation>
    </message>
    <message>
        <source>proposed region</source>
        <translation>vorgeschlagener Bereich</translation>
    </message>
    <message>
        <source>reading the structure</source>
        <translation>die Struktur wird gelesen</translation>
    </message>
    <message>
        <source>making the surface</source>
        <translation>die Oberfläche wird berechnet</translation>
    </message>
    <message>
        <source>the axes of '%1' were corrected since: undo that first</source>
        <translation>die Achsen von „%1“ wurden seither korrigiert: Nehmen Sie erst das zurück</translation>
    </message>
    <message>
        <source>threshold</source>
        <translation>Schwelle</translation>
    </message>
    <message>
        <source>paint stroke</source>
        <translation>Strich malen</translation>
    </message>
    <message>
        <source>erase stroke</source>
        <translation>Strich löschen</translation>
    </message>
    <message>
        <source>islands</source>
        <translation>Inseln</translation>
    </message>
    <message>
        <source>margin</source>
        <translation>Rand</translation>
    </message>
    <message>
        <source>smoothing</source>
        <translation>Glättung</translation>
    </message>
    <message>
        <source>filling between slices</source>
        <translation>Füllen zwischen Schichten</translation>
    </message>
    <message>
        <source>growing</source>
        <translation>Wachsen</translation>
    </message>
    <message>
        <source>tube</source>
        <translation>Röhre</translation>
    </message>
    <message>
        <source>%#1 long, radius %#2</source>
        <translation>%#1 lang, Radius %#2</translation>
    </message>
    <message>
        <source>by its name at most %#1</source>
        <translation>nach ihrem Namen höchstens %#1</translation>
    </message>
    <message>
        <source>The scan does not resolve it along %#1 of %#2: there the path is a guess between your points.</source>
        <translation>Die Aufnahme löst sie auf %#1 von %#2 nicht auf: Dort ist der Verlauf eine Vermutung zwischen Ihren Punkten.</translation>
    </message>
    <message>
        <source>The scan does not resolve it along %#1 of %#2: there the path and its radius are a guess between your points.</source>
        <translation>Die Aufnahme löst sie auf %#1 von %#2 nicht auf: Dort sind Verlauf und Radius eine Vermutung zwischen Ihren Punkten.</translation>
    </message>
    <message>
        <source>The points seem not to be in their order along the structure: %1 would make a much shorter line.</source>
        <translation>Die Punkte scheinen nicht in ihrer Reihenfolge entlang der Struktur zu liegen: %1 ergäbe eine viel kürzere Linie.</translation>
    </message>
    <message>
        <source>change of</source>
        <translation>Änderung von</translation>
    </message>
    <message>
        <source>create</source>
        <translation>Anlegen</translation>
    </message>
    <message>
        <source>No case is open.</source>
        <translation>Kein Fall ist offen.</translation>
    </message>
    <message>
        <source>A step is under way.</source>
        <translation>Ein Schritt läuft.</translation>
    </message>
    <message>
        <source>The preview is being computed.</source>
        <translation>Die Vorschau wird berechnet.</translation>
    </message>
    <message>
        <source>The tool has no result: %~1</source>
        <translation>Das Werkzeug hat kein Ergebnis: %~1</translation>
    </message>
    <message>
        <source>There is no voxel yet: paint, or use another tool.</source>
        <translation>Es gibt noch kein Voxel: Malen Sie, oder nehmen Sie ein anderes Werkzeug.</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>Nichts wurde geändert.</translation>
    </message>
    <message>
        <source>Give the structure a name.</source>
        <translation>Geben Sie der Struktur einen Namen.</translation>
    </message>
    <message>
        <source>The case has an %~1 '%2' already; choose another name.</source>
        <translation>Der Fall hat schon etwas namens „%2“ (%~1); wählen Sie einen anderen Namen.</translation>
    </message>
    <message>
        <source>The case has a %~1 '%2' already; choose another name.</source>
        <translation>Der Fall hat schon etwas namens „%2“ (%~1); wählen Sie einen anderen Namen.</translation>
    </message>
    <message>
        <source>there is a draft already; create or discard it first</source>
        <translation>es gibt schon einen Entwurf; legen Sie ihn an oder verwerfen Sie ihn erst</translation>
    </message>
    <message>
        <source>structure '%1' is not on the %~2</source>
        <translation>die Struktur „%1“ liegt nicht auf dem %~2</translation>
    </message>
    <message>
        <source>It was drawn on other voxels, and is now on those of the %~1: %#2 mm³ for %#3 mm³. Saving replaces what was drawn.</source>
        <translation>Sie wurde auf anderen Voxeln gezeichnet und liegt jetzt auf denen des %~1: %#2 mm³ statt %#3 mm³. Speichern ersetzt das Gezeichnete.</translation>
    </message>
    <message>
        <source>not registered to the %~1; see Registration, F5</source>
        <translation>nicht mit dem %~1 registriert; siehe Registrierung, F5</translation>
    </message>
    <message>
        <source>the case has no image '%1'</source>
        <translation>der Fall hat kein Bild „%1“</translation>
    </message>
    <message>
        <source>the MR '%1'</source>
        <translation>das MR „%1“</translation>
    </message>
    <message>
        <source>The slices show %1, but the tools work on %2.</source>
        <translation>Die Schichten zeigen %1, die Werkzeuge nutzen aber %2.</translation>
    </message>
    <message>
        <source>removal of the points</source>
        <translation>Entfernen der Punkte</translation>
    </message>
    <message>
        <source>Nothing was done: that point lies outside of the image.</source>
        <translation>Nichts geschah: Dieser Punkt liegt außerhalb des Bildes.</translation>
    </message>
    <message>
        <source>A step is under way; wait, or stop it.</source>
        <translation>Ein Schritt läuft; warten Sie, oder halten Sie ihn an.</translation>
    </message>
    <message>
        <source>The MR is being brought onto the grid of the %~1; then its range can be used.</source>
        <translation>Das MR wird auf das Gitter des %~1 gebracht; dann ist sein Bereich verwendbar.</translation>
    </message>
    <message>
        <source>There is nothing yet of which an island could be kept.</source>
        <translation>Es gibt noch nichts, wovon eine Insel bleiben könnte.</translation>
    </message>
    <message>
        <source>move of a point</source>
        <translation>Verschieben eines Punktes</translation>
    </message>
    <message>
        <source>stroke</source>
        <translation>Strich</translation>
    </message>
    <message>
        <source>beside the tube: move or remove it</source>
        <translation>neben der Röhre: verschieben oder entfernen</translation>
    </message>
    <message>
        <source>cannot be resolved here</source>
        <translation>hier nicht auflösbar</translation>
    </message>
    <message>
        <source>no axis nearby: the path is held at the point</source>
        <translation>keine Achse in der Nähe: der Verlauf wird am Punkt festgehalten</translation>
    </message>
    <message>
        <source>removal of a point</source>
        <translation>Entfernen eines Punktes</translation>
    </message>
    <message>
        <source>order of the points</source>
        <translation>Reihenfolge der Punkte</translation>
    </message>
    <message>
        <source>The brightest region is proposed; click points for another one, or all voxels of the range without 'connected'.</source>
        <translation>Vorgeschlagen ist der hellste Bereich; klicken Sie Punkte für einen anderen, oder nehmen Sie ohne „zusammenhängend“ alle Voxel der Spanne.</translation>
    </message>
    <message>
        <source>The limits were set around the clicked point.</source>
        <translation>Die Grenzen wurden um den angeklickten Punkt gesetzt.</translation>
    </message>
    <message>
        <source>Click a point of the structure in a slice.</source>
        <translation>Klicken Sie in einer Schicht auf einen Punkt der Struktur.</translation>
    </message>
    <message>
        <source>Choose a tool first.</source>
        <translation>Wählen Sie erst ein Werkzeug.</translation>
    </message>
    <message>
        <source>This tool works while you drag in a slice.</source>
        <translation>Dieses Werkzeug wirkt, während Sie in einer Schicht ziehen.</translation>
    </message>
    <message>
        <source>Click a point of the structure in a slice first.</source>
        <translation>Klicken Sie erst in einer Schicht auf einen Punkt der Struktur.</translation>
    </message>
    <message>
        <source>Click at least two points along the nerve first.</source>
        <translation>Klicken Sie erst auf mindestens zwei Punkte entlang des Nervs.</translation>
    </message>
    <message>
        <source>Paint a stroke inside the structure and one beside it first.</source>
        <translation>Malen Sie erst einen Strich in der Struktur und einen daneben.</translation>
    </message>
    <message>
        <source>A margin of 0 mm changes nothing.</source>
        <translation>Ein Rand von 0 mm ändert nichts.</translation>
    </message>
    <message>
        <source>There is nothing yet that could be changed.</source>
        <translation>Es gibt noch nichts, was sich ändern ließe.</translation>
    </message>
    <message>
        <source>The image was moved or changed while this was computed: the result is that of before. Undo it, and apply the tool again.</source>
        <translation>Das Bild wurde bewegt oder geändert, während gerechnet wurde: Das Ergebnis gilt für das vorherige. Nehmen Sie es zurück, und wenden Sie das Werkzeug noch einmal an.</translation>
    </message>
    <message>
        <source>This changes nothing.</source>
        <translation>Das ändert nichts.</translation>
    </message>
    <message>
        <source>create %1</source>
        <translation>%1 anlegen</translation>
    </message>
    <message>
        <source>change of %1</source>
        <translation>Änderung von %1</translation>
    </message>
    <message>
        <source>the structure that was created is not in the case any more</source>
        <translation>die angelegte Struktur ist nicht mehr im Fall</translation>
    </message>
    <message>
        <source>the structure is in the case already</source>
        <translation>die Struktur ist schon im Fall</translation>
    </message>
    <message>
        <source>undoing</source>
        <translation>wird rückgängig gemacht</translation>
    </message>
    <message>
        <source>redoing</source>
        <translation>wird wiederhergestellt</translation>
    </message>
    <message>
        <source>making the structure</source>
        <translation>die Struktur wird angelegt</translation>
    </message>
    <message>
        <source>looking for a free way</source>
        <translation>freier Weg wird gesucht</translation>
    </message>
    <message>
        <source>a film has 2 to %#1 frames, not %#2</source>
        <translation>ein Film hat 2 bis %#1 Bilder, nicht %#2</translation>
    </message>
    <message>
        <source>a flight needs a line of two different points</source>
        <translation>ein Flug braucht eine Linie aus zwei verschiedenen Punkten</translation>
    </message>
    <message>
        <source>the view has no up, about which it could turn</source>
        <translation>die Ansicht hat kein Oben, um das sie sich drehen könnte</translation>
    </message>
    <message>
        <source>flight: along the centre line of '%1' no stretch of %#2 mm is free: %3</source>
        <translation>Flug: entlang der Mittellinie von „%1“ ist keine Strecke von %#2 mm frei: %3</translation>
    </message>
    <message>
        <source>bone, or the edge of the image, is nearer than 0.3 mm</source>
        <translation>Knochen oder der Bildrand ist näher als 0,3 mm</translation>
    </message>
    <message>
        <source>structures that are shown close it at its ends; hide them</source>
        <translation>gezeigte Strukturen verschließen sie an den Enden; blenden Sie diese aus</translation>
    </message>
    <message>
        <source>flight: along the centre line of '%1' nothing is drawn</source>
        <translation>Flug: entlang der Mittellinie von „%1“ wird nichts gezeichnet</translation>
    </message>
    <message>
        <source>ffmpeg cannot be started: %1</source>
        <translation>ffmpeg lässt sich nicht starten: %1</translation>
    </message>
    <message>
        <source>ffmpeg could not encode the film; perhaps it has no H.264 (libx264), or the disk is full. A name that ends in .png writes the frames</source>
        <translation>ffmpeg konnte den Film nicht kodieren; vielleicht hat es kein H.264 (libx264), oder der Datenträger ist voll. Ein Name, der auf .png endet, schreibt die Bilder</translation>
    </message>
    <message>
        <source>a video needs the program ffmpeg, which is not installed (Debian's package ffmpeg); a name that ends in .png writes the frames instead</source>
        <translation>ein Video braucht das Programm ffmpeg, das nicht installiert ist (Debian-Paket ffmpeg); ein Name, der auf .png endet, schreibt stattdessen die Bilder</translation>
    </message>
    <message>
        <source>%1: a film is a video (.mp4) or pictures (.png)</source>
        <translation>%1: ein Film ist ein Video (.mp4) oder Bilder (.png)</translation>
    </message>
    <message>
        <source>drawing frame %#1 of %#2</source>
        <translation>Bild %#1 von %#2 wird gezeichnet</translation>
    </message>
    <message>
        <source>writing the film</source>
        <translation>der Film wird geschrieben</translation>
    </message>
    <message>
        <source>Left side</source>
        <translation>Linke Seite</translation>
    </message>
    <message>
        <source>Right side</source>
        <translation>Rechte Seite</translation>
    </message>
    <message>
        <source>Both sides</source>
        <translation>Beide Seiten</translation>
    </message>
    <message>
        <source>Side not stated</source>
        <translation>Seite nicht angegeben</translation>
    </message>
    <message>
        <source>writing the report</source>
        <translation>der Bericht wird geschrieben</translation>
    </message>
    <message>
        <source>the date of the planned operation: who has the list of that day's operations knows the patient by it</source>
        <translation>das Datum der geplanten Operation: Wer das Operationsprogramm dieses Tages hat, kennt daran den Patienten</translation>
    </message>
    <message>
        <source>names and the note, as they were typed</source>
        <translation>Namen und Notiz, wie sie eingegeben wurden</translation>
    </message>
    <message>
        <source>Left out</source>
        <translation>Weggelassen</translation>
    </message>
    <message>
        <source>The surgical position is not shown, as the case does not tell which ear it is.</source>
        <translation>Die Operationslage ist nicht gezeigt, da der Fall nicht sagt, welches Ohr es ist.</translation>
    </message>
    <message>
        <source>drawing slices</source>
        <translation>Schichten werden gezeichnet</translation>
    </message>
    <message>
        <source>refined by mutual information</source>
        <translation>verfeinert durch Transinformation</translation>
    </message>
    <message>
        <source>yes, by</source>
        <translation>ja, von</translation>
    </message>
    <message>
        <source>texts as they were typed, in which nobody was recognised: %~1; read them yourself</source>
        <translation>Texte wie eingegeben, in denen niemand erkannt wurde: %~1; lesen Sie sie selbst</translation>
    </message>
    <message>
        <source>report: the dissection of case '%1' is not loaded</source>
        <translation>Bericht: Das Präparat des Falls „%1“ ist nicht geladen</translation>
    </message>
    <message>
        <source>clipping plane</source>
        <translation>Schnittebene</translation>
    </message>
    <message>
        <source>crop box</source>
        <translation>Beschnittquader</translation>
    </message>
    <message>
        <source>what is cut away</source>
        <translation>Weggeschnittenes</translation>
    </message>
    <message>
        <source>Axial</source>
        <translation>Axial</translation>
    </message>
    <message>
        <source>Coronal</source>
        <translation>Koronar</translation>
    </message>
    <message>
        <source>Sagittal</source>
        <translation>Sagittal</translation>
    </message>
    <message>
        <source>slice: a picture of %#1 x %#2 pixels of %#3 mm; all must be above 0</source>
        <translation>Schicht: ein Bild von %#1 x %#2 Pixeln zu %#3 mm; alle müssen über 0 liegen</translation>
    </message>
    <message>
        <source>Across the tool</source>
        <translation>Quer zum Werkzeug</translation>
    </message>
    <message>
        <source>Along the tool</source>
        <translation>Längs des Werkzeugs</translation>
    </message>
    <message>
        <source>%1, turned %#2°</source>
        <translation>%1, gedreht %#2°</translation>
    </message>
    <message>
        <source>plane: the normal must be finite and longer than 0</source>
        <translation>Ebene: Die Normale muss endlich und länger als 0 sein</translation>
    </message>
    <message>
        <source>looking for landmarks that do not fit</source>
        <translation>nicht passende Landmarken werden gesucht</translation>
    </message>
    <message>
        <source>open a video first</source>
        <translation>öffnen Sie erst ein Video</translation>
    </message>
    <message>
        <source>there is no such bookmark</source>
        <translation>es gibt kein solches Lesezeichen</translation>
    </message>
    <message>
        <source>bookmark %#1</source>
        <translation>Lesezeichen %#1</translation>
    </message>
    <message>
        <source>bookmark '%1'</source>
        <translation>Lesezeichen „%1“</translation>
    </message>
    <message>
        <source>name of bookmark '%1'</source>
        <translation>Name des Lesezeichens „%1“</translation>
    </message>
    <message>
        <source>place of bookmark '%1'</source>
        <translation>Stelle des Lesezeichens „%1“</translation>
    </message>
    <message>
        <source>nothing is drilled yet, or the stroke is not saved yet</source>
        <translation>noch ist nichts gebohrt, oder der Bohrzug ist noch nicht gespeichert</translation>
    </message>
    <message>
        <source>untie bookmark '%1'</source>
        <translation>Lesezeichen „%1“ lösen</translation>
    </message>
    <message>
        <source>tie bookmark '%1'</source>
        <translation>Lesezeichen „%1“ binden</translation>
    </message>
    <message>
        <source>removal of bookmark '%1'</source>
        <translation>Entfernen des Lesezeichens „%1“</translation>
    </message>
    <message>
        <source>click the point in the still first</source>
        <translation>klicken Sie den Punkt erst im Standbild an</translation>
    </message>
    <message>
        <source>the crosshair is still at another landmark of this still; click the point of the patient in the 3D view or a slice first</source>
        <translation>das Fadenkreuz ist noch an einer anderen Landmarke dieses Standbilds; klicken Sie zuerst den Punkt des Patienten in der 3D-Ansicht oder einer Schicht an</translation>
    </message>
    <message>
        <source>landmark of a still</source>
        <translation>Landmarke eines Standbilds</translation>
    </message>
    <message>
        <source>the still has no such landmark</source>
        <translation>das Standbild hat keine solche Landmarke</translation>
    </message>
    <message>
        <source>removal of a landmark</source>
        <translation>Entfernen einer Landmarke</translation>
    </message>
    <message>
        <source>removal of a still's landmarks</source>
        <translation>Entfernen der Landmarken eines Standbilds</translation>
    </message>
    <message>
        <source>angle of view</source>
        <translation>Bildwinkel</translation>
    </message>
    <message>
        <source>opacity of a still</source>
        <translation>Deckkraft eines Standbilds</translation>
    </message>
    <message>
        <source>not stated</source>
        <translation>nicht angegeben</translation>
    </message>
    <message>
        <source>on the patient's left, %#1 to %#2 mm from the scanner's middle</source>
        <translation>links im Patienten, %#1 bis %#2 mm von der Mitte des Geräts</translation>
    </message>
    <message>
        <source>on the patient's right, %#1 to %#2 mm from the scanner's middle</source>
        <translation>rechts im Patienten, %#1 bis %#2 mm von der Mitte des Geräts</translation>
    </message>
    <message>
        <source>The side is stated as %~1, but all of the image lies %2. Is the side right? (A patient need not lie in the middle.)</source>
        <translation>Als Seite ist %~1 angegeben, das ganze Bild liegt aber %2. Stimmt die Seite? (Ein Patient muss nicht in der Mitte liegen.)</translation>
    </message>
    <message>
        <source>This is the %~1 ear</source>
        <translation>Dies ist das Ohr %~1</translation>
    </message>
    <message>
        <source>%1, but the side of the case is stated as %~2.</source>
        <translation>%1, als Seite des Falls ist aber %~2 angegeben.</translation>
    </message>
    <message>
        <source>%1, but all of the image lies %2.</source>
        <translation>%1, das ganze Bild liegt aber %2.</translation>
    </message>
    <message>
        <source>about %#1 s left</source>
        <translation>noch etwa %#1 s</translation>
    </message>
    <message>
        <source>about %#1 min left</source>
        <translation>noch etwa %#1 min</translation>
    </message>
    <message>
        <source>about %#1 h %#2 min left</source>
        <translation>noch etwa %#1 h %#2 min</translation>
    </message>
</context>
<context>
    <name>Appearance</name>
    <message>
        <source>Drawn in 3D and outlined in the slices</source>
        <translation>In 3D gezeichnet und in den Schichten umrandet</translation>
    </message>
    <message>
        <source>Felt by the burr: part of the tissue it rests on</source>
        <translation>Von der Fräse gefühlt: Teil des Gewebes, auf dem sie liegt</translation>
    </message>
    <message>
        <source>Taken by the drill; without the mark the drill leaves it whole</source>
        <translation>Wird gebohrt; ohne das Häkchen bleibt es beim Bohren ganz</translation>
    </message>
    <message>
        <source>drilled as</source>
        <translation>gebohrt als</translation>
    </message>
    <message>
        <source>What the drill meets in it; 'bone': bone by its density</source>
        <translation>Worauf die Fräse darin trifft; „bone“: Knochen nach seiner Dichte</translation>
    </message>
    <message>
        <source>bone is what its density says; only structures and meshes have a tissue of their own</source>
        <translation>Knochen ist, was seine Dichte sagt; nur Strukturen und Netze haben ein eigenes Gewebe</translation>
    </message>
    <message>
        <source>rigid</source>
        <translation>starr</translation>
    </message>
    <message>
        <source>How a structure yields: newtons a millimetre deep; or as a soft tissue (materials)</source>
        <translation>Wie eine Struktur nachgibt: Newton je Millimeter Tiefe; oder wie ein Weichgewebe (materials)</translation>
    </message>
    <message>
        <source>bone is rigid; only structures and meshes can yield</source>
        <translation>Knochen ist starr; nur Strukturen und Netze können nachgeben</translation>
    </message>
    <message>
        <source>warning distance</source>
        <translation>Warnabstand</translation>
    </message>
    <message>
        <source>warned of at</source>
        <translation>Warnung ab</translation>
    </message>
    <message>
        <source>How near a burr may come before it is warned of</source>
        <translation>Wie nah eine Fräse kommen darf, bevor gewarnt wird</translation>
    </message>
    <message>
        <source>bone is what is drilled; only structures and meshes are warned of</source>
        <translation>Knochen wird gebohrt; gewarnt wird nur vor Strukturen und Netzen</translation>
    </message>
    <message>
        <source>How near a burr may come before it is warned of, mm; 0: no warning. Double click to change</source>
        <translation>Wie nah eine Fräse kommen darf, bevor gewarnt wird, mm; 0: keine Warnung. Doppelklick ändert es</translation>
    </message>
    <message>
        <source>Opacity of the surface</source>
        <translation>Deckkraft der Oberfläche</translation>
    </message>
    <message>
        <source>transfer function</source>
        <translation>Transferfunktion</translation>
    </message>
    <message>
        <source>Transfer function; 'none' for one colour</source>
        <translation>Transferfunktion; „none“ für eine Farbe</translation>
    </message>
    <message>
        <source>The image whose intensities are read</source>
        <translation>Das Bild, dessen Intensitäten gelesen werden</translation>
    </message>
    <message>
        <source>two presets are called '%1'</source>
        <translation>zwei Vorgaben heißen „%1“</translation>
    </message>
    <message>
        <source>must be {"presets": [...]}, as the presets of structures.json</source>
        <translation>muss {"presets": [...]} sein, wie die Vorgaben in structures.json</translation>
    </message>
    <message>
        <source>there is no preset '%1'; there are %2</source>
        <translation>es gibt keine Vorgabe „%1“; es gibt %2</translation>
    </message>
    <message>
        <source>preset '%1' is built in and cannot be removed</source>
        <translation>die Vorgabe „%1“ ist eingebaut und lässt sich nicht entfernen</translation>
    </message>
    <message>
        <source>the library has no preset '%1'</source>
        <translation>die Bibliothek hat keine Vorgabe „%1“</translation>
    </message>
    <message>
        <source>preset's name: %~1</source>
        <translation>Name der Vorgabe: %~1</translation>
    </message>
    <message>
        <source>must have 1 to %#1 bytes</source>
        <translation>muss 1 bis %#1 Byte haben</translation>
    </message>
    <message>
        <source>must be UTF-8 text without control characters</source>
        <translation>muss Text in UTF-8 ohne Steuerzeichen sein</translation>
    </message>
    <message>
        <source>must not begin or end with a space</source>
        <translation>darf nicht mit einem Leerzeichen beginnen oder enden</translation>
    </message>
    <message>
        <source>'%1' is a built-in preset</source>
        <translation>„%1“ ist eine eingebaute Vorgabe</translation>
    </message>
    <message>
        <source>modulus and lengths of a contact must be above 0</source>
        <translation>Modul und Längen eines Kontakts müssen über 0 liegen</translation>
    </message>
    <message>
        <source>'%1' must be the lowest, the usual and the highest value, above 0</source>
        <translation>„%1“ muss der niedrigste, der übliche und der höchste Wert sein, über 0</translation>
    </message>
    <message>
        <source>there is no contact '%1'; there are solid and membrane</source>
        <translation>es gibt keinen Kontakt „%1“; es gibt solid und membrane</translation>
    </message>
    <message>
        <source>%1: not a table of soft tissues</source>
        <translation>%1: keine Tabelle von Weichgeweben</translation>
    </message>
    <message>
        <source>flag '%~1' is unknown; use %2 or none</source>
        <translation>Kennzeichen „%~1“ ist unbekannt; nehmen Sie %2 oder none</translation>
    </message>
    <message>
        <source>flags '%1': give all of them a sign (+touchable,-drillable), or none</source>
        <translation>Merkmale „%1“: alle mit Vorzeichen angeben (+touchable,-drillable) oder keines</translation>
    </message>
    <message>
        <source>colour: red, green and blue must lie in 0 to 1</source>
        <translation>Farbe: Rot, Grün und Blau müssen in 0 bis 1 liegen</translation>
    </message>
    <message>
        <source>%1: is not a number</source>
        <translation>%1: ist keine Zahl</translation>
    </message>
    <message>
        <source>transfer function: point %#1: %~2</source>
        <translation>Transferfunktion: Punkt %#1: %~2</translation>
    </message>
    <message>
        <source>transfer function: at least one point is needed</source>
        <translation>Transferfunktion: mindestens ein Punkt ist nötig</translation>
    </message>
    <message>
        <source>the value must be a finite number</source>
        <translation>der Wert muss eine endliche Zahl sein</translation>
    </message>
    <message>
        <source>values must rise from point to point</source>
        <translation>Werte müssen von Punkt zu Punkt steigen</translation>
    </message>
    <message>
        <source>colour must lie in 0 to 1</source>
        <translation>die Farbe muss in 0 bis 1 liegen</translation>
    </message>
    <message>
        <source>opacity (of 1 mm) must lie in 0 to 1</source>
        <translation>die Deckkraft (von 1 mm) muss in 0 bis 1 liegen</translation>
    </message>
    <message>
        <source>specular must lie in 0 to 1</source>
        <translation>der Glanz muss in 0 bis 1 liegen</translation>
    </message>
    <message>
        <source>transfer function: %~1</source>
        <translation>Transferfunktion: %~1</translation>
    </message>
    <message>
        <source>%1'%2' means nothing here; use %~3</source>
        <translation>%1„%2“ bedeutet hier nichts; nehmen Sie %~3</translation>
    </message>
    <message>
        <source>%1'%2' is missing</source>
        <translation>%1„%2“ fehlt</translation>
    </message>
    <message>
        <source>%1'%2' must be a number</source>
        <translation>%1„%2“ muss eine Zahl sein</translation>
    </message>
    <message>
        <source>%1'color' must be [red, green, blue], each 0 to 1</source>
        <translation>%1„color“ muss [Rot, Grün, Blau] sein, je 0 bis 1</translation>
    </message>
    <message>
        <source>not JSON; look at line %#1</source>
        <translation>kein JSON; sehen Sie in Zeile %#1 nach</translation>
    </message>
    <message>
        <source>not JSON that can be read: a number is too large</source>
        <translation>kein lesbares JSON: eine Zahl ist zu groß</translation>
    </message>
    <message>
        <source>has %#1 points; at most %#2 are taken</source>
        <translation>hat %#1 Punkte; höchstens %#2 werden genommen</translation>
    </message>
    <message>
        <source>point %#1</source>
        <translation>Punkt %#1</translation>
    </message>
</context>
<context>
    <name>Core</name>
    <message>
        <source>axes: '%1' is not one letter each of R or L, A or P, and S or I (H or F), such as LPS (as the file states them) or RPS (left and right exchanged)</source>
        <translation>Achsen: „%1“ hat nicht je einen Buchstaben aus R oder L, A oder P und S oder I (H oder F), wie LPS (wie die Datei sie angibt) oder RPS (links und rechts getauscht)</translation>
    </message>
    <message>
        <source>%1, line 1: column '%2' is there twice</source>
        <translation>%1, Zeile 1: Die Spalte „%2“ gibt es zweimal</translation>
    </message>
    <message>
        <source>%1, line 1: there is no column '%2'; the first line must name the columns</source>
        <translation>%1, Zeile 1: Es gibt keine Spalte „%2“; die erste Zeile muss die Spalten benennen</translation>
    </message>
    <message>
        <source>%1, line %#2: %#3 field, and %#4 columns in the first line; numbers need a decimal point, and each column a field</source>
        <translation>%1, Zeile %#2: %#3 Feld, und %#4 Spalten in der ersten Zeile; Zahlen brauchen einen Dezimalpunkt und jede Spalte ein Feld</translation>
    </message>
    <message>
        <source>%1, line %#2: %#3 fields, and %#4 columns in the first line; numbers need a decimal point, and each column a field</source>
        <translation>%1, Zeile %#2: %#3 Felder, und %#4 Spalten in der ersten Zeile; Zahlen brauchen einen Dezimalpunkt und jede Spalte ein Feld</translation>
    </message>
    <message>
        <source>%1, line %#2: '%3' is not a finite number; numbers need a decimal point</source>
        <translation>%1, Zeile %#2: „%3“ ist keine endliche Zahl; Zahlen brauchen einen Dezimalpunkt</translation>
    </message>
    <message>
        <source>%1: there is no row after the header</source>
        <translation>%1: Nach der Kopfzeile kommt keine Zeile</translation>
    </message>
    <message>
        <source>%1, line %#2: a quote is opened and not closed</source>
        <translation>%1, Zeile %#2: Ein Anführungszeichen wird geöffnet und nicht geschlossen</translation>
    </message>
    <message>
        <source>%1: cancelled; nothing was changed</source>
        <translation>%1: abgebrochen; nichts wurde geändert</translation>
    </message>
    <message>
        <source>cannot be locked: this drive has no file locks, as some network drives; choose a folder on a local disk</source>
        <translation>lässt sich nicht sperren: Dieses Laufwerk kennt keine Dateisperren, wie manche Netzlaufwerke; wählen Sie einen Ordner auf einem lokalen Datenträger</translation>
    </message>
    <message>
        <source>is in use by another program; wait until it has ended</source>
        <translation>ist in einem anderen Programm offen; warten Sie, bis es beendet ist</translation>
    </message>
    <message>
        <source>grid: every dimension must be at least 1, not %#1 x %#2 x %#3</source>
        <translation>Gitter: Jede Abmessung muss mindestens 1 sein, nicht %#1 x %#2 x %#3</translation>
    </message>
    <message>
        <source>grid: the spacing must be finite and above 0 mm</source>
        <translation>Gitter: Der Abstand muss endlich und über 0 mm sein</translation>
    </message>
    <message>
        <source>grid: the origin is not finite</source>
        <translation>Gitter: Der Ursprung ist nicht endlich</translation>
    </message>
    <message>
        <source>grid: the direction cosines are not perpendicular unit vectors</source>
        <translation>Gitter: Die Richtungskosinus sind keine senkrechten Einheitsvektoren</translation>
    </message>
    <message>
        <source>grid: the box to crop to is empty or reaches outside the grid</source>
        <translation>Gitter: Der Bereich zum Beschneiden ist leer oder reicht über das Gitter hinaus</translation>
    </message>
    <message>
        <source>there is no such file; check the name</source>
        <translation>diese Datei gibt es nicht; prüfen Sie den Namen</translation>
    </message>
    <message>
        <source>may not be opened; allow reading it</source>
        <translation>darf nicht geöffnet werden; erlauben Sie das Lesen</translation>
    </message>
    <message>
        <source>is not a regular file; name one</source>
        <translation>ist keine gewöhnliche Datei; nennen Sie eine</translation>
    </message>
    <message>
        <source>cannot be opened (system error %#1)</source>
        <translation>lässt sich nicht öffnen (Systemfehler %#1)</translation>
    </message>
    <message>
        <source>is a folder; name a file in it</source>
        <translation>ist ein Ordner; nennen Sie eine Datei darin</translation>
    </message>
    <message>
        <source>is a named pipe and not a regular file; save the data to a file first</source>
        <translation>ist eine benannte Pipe und keine gewöhnliche Datei; speichern Sie die Daten erst in eine Datei</translation>
    </message>
    <message>
        <source>is a device or socket and not a regular file; name a file</source>
        <translation>ist ein Gerät oder Socket und keine gewöhnliche Datei; nennen Sie eine Datei</translation>
    </message>
    <message>
        <source>holds %~1, more than the %~2 that such a file may have</source>
        <translation>enthält %~1, mehr als die %~2, die eine solche Datei haben darf</translation>
    </message>
    <message>
        <source>broke off while it was read; check the disk</source>
        <translation>brach beim Lesen ab; prüfen Sie den Datenträger</translation>
    </message>
    <message>
        <source>above %#1, up to %~2</source>
        <translation>über %#1, bis %~2</translation>
    </message>
    <message>
        <source>%#1 to %~2</source>
        <translation>%#1 bis %~2</translation>
    </message>
    <message>
        <source>must lie %~1, or be '%~2', not %#3</source>
        <translation>muss %~1 liegen oder „%~2“ sein, nicht %#3</translation>
    </message>
    <message>
        <source>must lie %~1, not %#2</source>
        <translation>muss %~1 liegen, nicht %#2</translation>
    </message>
    <message>
        <source>must lie within %~1, or be '%~2', not %#3</source>
        <translation>muss in %~1 liegen oder „%~2“ sein, nicht %#3</translation>
    </message>
    <message>
        <source>must lie within %~1, not %#2</source>
        <translation>muss in %~1 liegen, nicht %#2</translation>
    </message>
    <message>
        <source>cannot be written, the disk is full; free some space and try again</source>
        <translation>lässt sich nicht schreiben, der Datenträger ist voll; schaffen Sie Platz, und versuchen Sie es noch einmal</translation>
    </message>
    <message>
        <source>cannot be written, the disk is full or the file too large for it; choose another disk</source>
        <translation>lässt sich nicht schreiben, der Datenträger ist voll oder die Datei zu groß für ihn; wählen Sie einen anderen</translation>
    </message>
    <message>
        <source>cannot be written, no permission; choose another folder or allow writing to this one</source>
        <translation>lässt sich nicht schreiben, keine Berechtigung; wählen Sie einen anderen Ordner, oder erlauben Sie das Schreiben in diesen</translation>
    </message>
    <message>
        <source>cannot be written, the medium is read-only; choose another folder</source>
        <translation>lässt sich nicht schreiben, der Datenträger ist schreibgeschützt; wählen Sie einen anderen Ordner</translation>
    </message>
    <message>
        <source>cannot be written, its folder is not there; make the folder first</source>
        <translation>lässt sich nicht schreiben, der Ordner ist nicht da; legen Sie ihn erst an</translation>
    </message>
    <message>
        <source>cannot be written, something of one of its names appeared there meanwhile; name another folder</source>
        <translation>lässt sich nicht schreiben, dort ist inzwischen etwas gleichen Namens entstanden; nennen Sie einen anderen Ordner</translation>
    </message>
    <message>
        <source>cannot be written, a file stands where its folder should be</source>
        <translation>lässt sich nicht schreiben, wo der Ordner sein soll, steht eine Datei</translation>
    </message>
    <message>
        <source>cannot be written: this drive cannot replace a file in one step, as some network drives; choose a folder on a local disk</source>
        <translation>lässt sich nicht schreiben: Dieses Laufwerk kann eine Datei nicht in einem Schritt ersetzen, wie manche Netzlaufwerke; wählen Sie einen Ordner auf einem lokalen Datenträger</translation>
    </message>
    <message>
        <source>cannot be written, the name is too long; shorten it</source>
        <translation>lässt sich nicht schreiben, der Name ist zu lang; kürzen Sie ihn</translation>
    </message>
    <message>
        <source>cannot be written (system error %#1); check the disk</source>
        <translation>lässt sich nicht schreiben (Systemfehler %#1); prüfen Sie den Datenträger</translation>
    </message>
    <message>
        <source>is a device, pipe or socket; name a regular file</source>
        <translation>ist ein Gerät, eine Pipe oder ein Socket; nennen Sie eine gewöhnliche Datei</translation>
    </message>
    <message>
        <source>is a file; name a new or an empty folder</source>
        <translation>ist eine Datei; nennen Sie einen neuen oder leeren Ordner</translation>
    </message>
    <message>
        <source>not empty; name a new or an empty folder</source>
        <translation>nicht leer; nennen Sie einen neuen oder leeren Ordner</translation>
    </message>
    <message>
        <source>rigid transform: the quaternion is zero or not finite</source>
        <translation>starre Transformation: Das Quaternion ist null oder nicht endlich</translation>
    </message>
    <message>
        <source>rigid transform: the translation is not finite</source>
        <translation>starre Transformation: Die Verschiebung ist nicht endlich</translation>
    </message>
    <message>
        <source>rigid transform: the matrix is not a rotation (sheared, scaled or mirrored); only rigid motions are accepted</source>
        <translation>starre Transformation: Die Matrix ist keine Drehung (geschert, skaliert oder gespiegelt); nur starre Bewegungen werden angenommen</translation>
    </message>
    <message>
        <source>rigid transform: the last row must be 0 0 0 1</source>
        <translation>starre Transformation: Die letzte Zeile muss 0 0 0 1 sein</translation>
    </message>
    <message>
        <source>mesh: a vertex is not finite</source>
        <translation>Netz: Eine Ecke ist nicht endlich</translation>
    </message>
    <message>
        <source>mesh: a triangle names vertex %#1 of %#2</source>
        <translation>Netz: Ein Dreieck nennt die Ecke %#1 von %#2</translation>
    </message>
</context>
<context>
    <name>Devices</name>
    <message>
        <source>usage: %s</source>
        <translation>Aufruf: %s</translation>
    </message>
    <message>
        <source>%1 cannot be loaded</source>
        <translation>%1 lässt sich nicht laden</translation>
    </message>
    <message>
        <source>the vendor's library %1 is not installed; where it lies elsewhere, %2 names it</source>
        <translation>die Bibliothek %1 des Herstellers ist nicht installiert; liegt sie anderswo, nennt %2 sie</translation>
    </message>
    <message>
        <source>the vendor's library has no function %1</source>
        <translation>die Bibliothek des Herstellers hat keine Funktion %1</translation>
    </message>
    <message>
        <source>unknown error</source>
        <translation>unbekannter Fehler</translation>
    </message>
    <message>
        <source>its forces are off: press the force button on the device</source>
        <translation>seine Kräfte sind aus: drücken Sie die Krafttaste am Gerät</translation>
    </message>
    <message>
        <source>its forces are off, as it was moved too fast: hold it still</source>
        <translation>seine Kräfte sind aus, da es zu schnell bewegt wurde: halten Sie es still</translation>
    </message>
    <message>
        <source>its forces are off, as it had no command for 30 ms; they return in a second</source>
        <translation>seine Kräfte sind aus, da es 30 ms keinen Befehl bekam; sie kehren in einer Sekunde zurück</translation>
    </message>
    <message>
        <source>its forces are off: hold the dead man's switch</source>
        <translation>seine Kräfte sind aus: halten Sie den Totmannschalter</translation>
    </message>
    <message>
        <source>it was unplugged or switched off</source>
        <translation>es wurde ausgesteckt oder ausgeschaltet</translation>
    </message>
    <message>
        <source>it has no power: switch it on</source>
        <translation>es hat keinen Strom: schalten Sie es ein</translation>
    </message>
    <message>
        <source>the device reports an error: switch it off and on</source>
        <translation>das Gerät meldet einen Fehler: schalten Sie es aus und ein</translation>
    </message>
    <message>
        <source>it is not calibrated: run HapticInit of the SDK; a Falcon's grip is pulled out and pushed in once</source>
        <translation>es ist nicht kalibriert: starten Sie HapticInit des SDK; den Griff eines Falcon zieht man einmal heraus und schiebt ihn hinein</translation>
    </message>
    <message>
        <source>Force Dimension device</source>
        <translation>Gerät von Force Dimension</translation>
    </message>
    <message>
        <source>Force Dimension %1</source>
        <translation>Force Dimension %1</translation>
    </message>
    <message>
        <source>its Inverse3 is not connected to the Inverse service</source>
        <translation>sein Inverse3 ist nicht mit dem Inverse-Dienst verbunden</translation>
    </message>
    <message>
        <source>the Inverse service does not tell whether it is ready</source>
        <translation>der Inverse-Dienst sagt nicht, ob es bereit ist</translation>
    </message>
    <message>
        <source>it has no power supply: plug it in; its forces are off</source>
        <translation>es hat keine Stromversorgung: stecken Sie es ein; seine Kräfte sind aus</translation>
    </message>
    <message>
        <source>it is not calibrated: put the grip into the holder on its base</source>
        <translation>es ist nicht kalibriert: legen Sie den Griff in die Halterung am Sockel</translation>
    </message>
    <message>
        <source>it is not ready; its forces are off</source>
        <translation>es ist nicht bereit; seine Kräfte sind aus</translation>
    </message>
    <message>
        <source>the Inverse service does not answer: start haply-inverse-service</source>
        <translation>der Inverse-Dienst antwortet nicht: starten Sie haply-inverse-service</translation>
    </message>
    <message>
        <source>no Inverse3 is connected to the Inverse service</source>
        <translation>kein Inverse3 ist mit dem Inverse-Dienst verbunden</translation>
    </message>
    <message>
        <source>the Inverse service is slow to answer</source>
        <translation>der Inverse-Dienst antwortet langsam</translation>
    </message>
    <message>
        <source>the Inverse service has ended</source>
        <translation>der Inverse-Dienst endete</translation>
    </message>
    <message>
        <source>the Inverse service has not answered for 0.2 s</source>
        <translation>der Inverse-Dienst antwortet seit 0.2 s nicht</translation>
    </message>
    <message>
        <source>no OpenIGTLink server answers at %1 port %2</source>
        <translation>kein OpenIGTLink-Server antwortet bei %1, Port %2</translation>
    </message>
    <message>
        <source>OpenIGTLink tracker</source>
        <translation>OpenIGTLink-Tracker</translation>
    </message>
    <message>
        <source>the OpenIGTLink server has ended</source>
        <translation>der OpenIGTLink-Server endete</translation>
    </message>
    <message>
        <source>the tracker does not see '%1'</source>
        <translation>der Tracker sieht „%1“ nicht</translation>
    </message>
    <message>
        <source>the tracker has not sent a pose%1</source>
        <translation>der Tracker hat keine Lage gesendet%1</translation>
    </message>
    <message>
        <source>the tracker has not sent a pose of '%1'</source>
        <translation>der Tracker hat keine Lage von „%1“ gesendet</translation>
    </message>
    <message>
        <source>it is being calibrated: hold it still</source>
        <translation>es wird kalibriert: halten Sie es still</translation>
    </message>
    <message>
        <source>it is not calibrated: put the stylus into the inkwell</source>
        <translation>es ist nicht kalibriert: stecken Sie den Stift in die Halterung</translation>
    </message>
    <message>
        <source>it is not calibrated: run Touch Diagnostic of the driver</source>
        <translation>es ist nicht kalibriert: starten Sie Touch Diagnostic des Treibers</translation>
    </message>
    <message>
        <source>OpenHaptics device</source>
        <translation>OpenHaptics-Gerät</translation>
    </message>
    <message>
        <source>it cannot be opened: %~1; the driver's set-up program must have paired it</source>
        <translation>es lässt sich nicht öffnen: %~1; das Einrichtungsprogramm des Treibers muss es gekoppelt haben</translation>
    </message>
    <message>
        <source>the vendor's scheduler does not start: %~1</source>
        <translation>der Scheduler des Herstellers startet nicht: %~1</translation>
    </message>
    <message>
        <source>its motors are hot: let it rest; the forces return by themselves</source>
        <translation>seine Motoren sind heiß: lassen Sie es ruhen; die Kräfte kehren von selbst zurück</translation>
    </message>
    <message>
        <source>its forces are off: %~1</source>
        <translation>seine Kräfte sind aus: %~1</translation>
    </message>
    <message>
        <source>it was unplugged or switched off: %~1</source>
        <translation>es wurde ausgesteckt oder ausgeschaltet: %~1</translation>
    </message>
    <message>
        <source>the SDK reports: %~1</source>
        <translation>das SDK meldet: %~1</translation>
    </message>
    <message>
        <source>its forces are off: the driver disabled them; choose the device again</source>
        <translation>seine Kräfte sind aus: Der Treiber hat sie abgeschaltet; wählen Sie das Gerät neu</translation>
    </message>
    <message>
        <source>device server '%1': a name has 1 to 48 letters, digits, '.', '-' or '_'</source>
        <translation>Geräteserver „%1“: Ein Name hat 1 bis 48 Buchstaben, Ziffern, „.“, „-“ oder „_“</translation>
    </message>
    <message>
        <source>device server '%1': cannot make the shared memory %2: %3</source>
        <translation>Geräteserver „%1“: Der gemeinsame Speicher %2 lässt sich nicht anlegen: %3</translation>
    </message>
    <message>
        <source>device server '%1': in use by another Petrous, which has locked %2</source>
        <translation>Geräteserver „%1“: Ein anderes Petrous verwendet ihn und hat %2 gesperrt</translation>
    </message>
    <message>
        <source>SpaceMouse Wireless, on its cable</source>
        <translation>SpaceMouse Wireless, am Kabel</translation>
    </message>
    <message>
        <source>SpaceMouse Pro Wireless, on its cable</source>
        <translation>SpaceMouse Pro Wireless, am Kabel</translation>
    </message>
    <message>
        <source>SpaceMouse Pro Wireless, Bluetooth edition</source>
        <translation>SpaceMouse Pro Wireless, Bluetooth-Ausgabe</translation>
    </message>
    <message>
        <source>SpaceMouse Wireless, Bluetooth edition</source>
        <translation>SpaceMouse Wireless, Bluetooth-Ausgabe</translation>
    </message>
    <message>
        <source>VEC Infinity foot pedal</source>
        <translation>Fußpedal VEC Infinity</translation>
    </message>
    <message>
        <source>PCsensor foot switch</source>
        <translation>Fußschalter PCsensor</translation>
    </message>
    <message>
        <source>%1 types a key: choose that key for the drill</source>
        <translation>%1 sendet eine Taste: Wählen Sie diese Taste zum Bohren</translation>
    </message>
    <message>
        <source>%1 is plugged in, but you may not open %2: copy 70-petrous-devices.rules to /etc/udev/rules.d, run 'udevadm control --reload-rules' as root, and plug it in again</source>
        <translation>%1 ist eingesteckt, aber Sie dürfen %2 nicht öffnen: Kopieren Sie 70-petrous-devices.rules nach /etc/udev/rules.d, führen Sie als root „udevadm control --reload-rules“ aus, und stecken Sie das Gerät neu ein</translation>
    </message>
    <message>
        <source>%1 was unplugged: %2 has gone</source>
        <translation>%1 wurde ausgesteckt: %2 ist weg</translation>
    </message>
    <message>
        <source>%1 is plugged in, but %2 cannot be opened</source>
        <translation>%1 ist eingesteckt, aber %2 lässt sich nicht öffnen</translation>
    </message>
    <message>
        <source>device test: %~1</source>
        <translation>Gerätetest: %~1</translation>
    </message>
    <message>
        <source>the time to wait for the device must be above 0 s</source>
        <translation>die Wartezeit auf das Gerät muss über 0 s liegen</translation>
    </message>
    <message>
        <source>the time for the workspace must be 0.5 s or more</source>
        <translation>die Zeit für den Arbeitsraum muss mindestens 0.5 s sein</translation>
    </message>
    <message>
        <source>the step of force must be above 0 N</source>
        <translation>der Kraftschritt muss über 0 N liegen</translation>
    </message>
    <message>
        <source>the ramp must end between 0.1 and 20 N/mm</source>
        <translation>die Rampe muss zwischen 0.1 und 20 N/mm enden</translation>
    </message>
    <message>
        <source>the device's readings stopped again and again</source>
        <translation>die Messungen des Geräts setzten immer wieder aus</translation>
    </message>
    <message>
        <source>the handle does not rest; hold it lightly in the middle, and keep it still</source>
        <translation>der Griff ruht nicht; halten Sie ihn locker in der Mitte, und halten Sie ihn ruhig</translation>
    </message>
    <message>
        <source>the handle moved against the force along %~1: do not use the device</source>
        <translation>der Griff bewegte sich gegen die Kraft entlang %~1: Benutzen Sie das Gerät nicht</translation>
    </message>
    <message>
        <source>the handle was pulled away again and again; hold it lightly where it is</source>
        <translation>der Griff wurde immer wieder weggezogen; halten Sie ihn leicht, wo er ist</translation>
    </message>
    <message>
        <source>no good reading came from the device</source>
        <translation>vom Gerät kam keine gute Ablesung</translation>
    </message>
    <message>
        <source>the device was lost</source>
        <translation>das Gerät ging verloren</translation>
    </message>
    <message>
        <source>%1: has no function %2, which hidapi 0.13 has</source>
        <translation>%1: hat die Funktion %2 nicht, die hidapi 0.13 hat</translation>
    </message>
    <message>
        <source>%1: cannot be loaded as hidapi: %2</source>
        <translation>%1: lässt sich nicht als hidapi laden: %2</translation>
    </message>
    <message>
        <source>%1: cannot be initialised</source>
        <translation>%1: lässt sich nicht initialisieren</translation>
    </message>
    <message>
        <source>no %~1 is plugged in</source>
        <translation>%~1 ist nicht eingesteckt</translation>
    </message>
    <message>
        <source>cannot be read</source>
        <translation>lässt sich nicht lesen</translation>
    </message>
    <message>
        <source>the %~1 was unplugged, or reading it failed</source>
        <translation>%~1 wurde ausgesteckt, oder das Lesen misslang</translation>
    </message>
    <message>
        <source>device server '%1': its time limits must be above 0 s</source>
        <translation>Geräteserver „%1“: Die Fristen müssen über 0 s liegen</translation>
    </message>
    <message>
        <source>was killed by signal %#1 (%2)</source>
        <translation>wurde durch Signal %#1 beendet (%2)</translation>
    </message>
    <message>
        <source>was killed by signal %#1 (unknown)</source>
        <translation>wurde durch Signal %#1 beendet (unbekannt)</translation>
    </message>
    <message>
        <source>ended by itself with status %#1</source>
        <translation>beendete sich mit Status %#1</translation>
    </message>
    <message>
        <source>cannot start %1: %2</source>
        <translation>%1 lässt sich nicht starten: %2</translation>
    </message>
    <message>
        <source>ended; how, the system does not say</source>
        <translation>endete; wie, sagt das System nicht</translation>
    </message>
    <message>
        <source>describes a device with a %~1 of %#2 %~3; it must lie between 0 and %#4</source>
        <translation>beschreibt ein Gerät mit %~1 von %#2 %~3; sie muss zwischen 0 und %#4 liegen</translation>
    </message>
    <message>
        <source>angular stiffness</source>
        <translation>Drehsteifigkeit</translation>
    </message>
    <message>
        <source>device server '%1' is not waited for any longer</source>
        <translation>auf den Geräteserver „%1“ wird nicht mehr gewartet</translation>
    </message>
    <message>
        <source>speaks version %#1 of the protocol, Petrous version %#2</source>
        <translation>spricht Version %#1 des Protokolls, Petrous Version %#2</translation>
    </message>
    <message>
        <source>%1; that was the %#2th time in a row, and it is not started again</source>
        <translation>%1; das war zum %#2. Mal in Folge, und er wird nicht mehr gestartet</translation>
    </message>
    <message>
        <source>has gone</source>
        <translation>ist weg</translation>
    </message>
    <message>
        <source>has no device%~1</source>
        <translation>hat kein Gerät%~1</translation>
    </message>
    <message>
        <source>has no device: %~1</source>
        <translation>hat kein Gerät: %~1</translation>
    </message>
    <message>
        <source>reports a fault%~1</source>
        <translation>meldet einen Fehler%~1</translation>
    </message>
    <message>
        <source>reports a fault: %~1</source>
        <translation>meldet einen Fehler: %~1</translation>
    </message>
    <message>
        <source>is in state %#1, which there is not</source>
        <translation>ist im Zustand %#1, den es nicht gibt</translation>
    </message>
    <message>
        <source>waits: %~1</source>
        <translation>wartet: %~1</translation>
    </message>
    <message>
        <source>was not started: nobody opened %1 within %#2</source>
        <translation>wurde nicht gestartet: Niemand öffnete %1 innerhalb von %#2</translation>
    </message>
    <message>
        <source>is not ready after %~1</source>
        <translation>ist nach %~1 nicht bereit</translation>
    </message>
    <message>
        <source>is not ready after %#1: %~2</source>
        <translation>ist nach %#1 nicht bereit: %~2</translation>
    </message>
    <message>
        <source>hangs: it has not answered for %#1</source>
        <translation>hängt: antwortet seit %#1 nicht</translation>
    </message>
    <message>
        <source>came back as another device (%1)</source>
        <translation>kam als ein anderes Gerät zurück (%1)</translation>
    </message>
    <message>
        <source>device server '%1' (process %#2)</source>
        <translation>Geräteserver „%1“ (Prozess %#2)</translation>
    </message>
    <message>
        <source>device server '%1'</source>
        <translation>Geräteserver „%1“</translation>
    </message>
    <message>
        <source>SpaceMouse: the time between two looks must be above 0 s</source>
        <translation>SpaceMouse: Die Zeit zwischen zwei Abfragen muss über 0 s liegen</translation>
    </message>
</context>
<context>
    <name>Dissection</name>
    <message>
        <source>stroke: only its metadata are known</source>
        <translation>Bohrzug: nur seine Metadaten sind bekannt</translation>
    </message>
    <message>
        <source>the history is that of other strokes</source>
        <translation>der Verlauf gehört zu anderen Bohrzügen</translation>
    </message>
    <message>
        <source>dissection: a stroke is open</source>
        <translation>Präparat: ein Bohrzug ist offen</translation>
    </message>
    <message>
        <source>dissection: the history is that of other strokes</source>
        <translation>Präparat: Der Verlauf gehört zu anderen Bohrzügen</translation>
    </message>
    <message>
        <source>dissection: a stroke is open already</source>
        <translation>Präparat: ein Bohrzug ist schon offen</translation>
    </message>
    <message>
        <source>dissection: is not loaded</source>
        <translation>Präparat: ist nicht geladen</translation>
    </message>
    <message>
        <source>dissection: no stroke is open</source>
        <translation>Präparat: kein Bohrzug ist offen</translation>
    </message>
    <message>
        <source>history: stroke %#1 follows one that was made after it</source>
        <translation>Verlauf: Der Bohrzug %#1 folgt einem, der nach ihm entstand</translation>
    </message>
    <message>
        <source>history: the present branch does not exist</source>
        <translation>Verlauf: Den jetzigen Zugang gibt es nicht</translation>
    </message>
    <message>
        <source>history: branch '%1' ends with a stroke that is not there</source>
        <translation>Verlauf: Der Zugang „%1“ endet mit einem Bohrzug, der nicht da ist</translation>
    </message>
    <message>
        <source>history: the state of branch '%1' is not on it</source>
        <translation>Verlauf: Der Stand des Zugangs „%1“ liegt nicht auf ihm</translation>
    </message>
    <message>
        <source>history: more strokes are done than there are</source>
        <translation>Verlauf: Mehr Bohrzüge sind ausgeführt, als es gibt</translation>
    </message>
    <message>
        <source>no branch '%1'; there are: %2</source>
        <translation>kein Zugang „%1“; es gibt: %2</translation>
    </message>
    <message>
        <source>branch: give it a name</source>
        <translation>Zugang: Geben Sie ihm einen Namen</translation>
    </message>
    <message>
        <source>branch '%1' is there already; choose another name</source>
        <translation>der Zugang „%1“ ist schon da; wählen Sie einen anderen Namen</translation>
    </message>
    <message>
        <source>branch '%1': there are only %#2 strokes</source>
        <translation>Zugang „%1“: Es gibt nur %#2 Bohrzüge</translation>
    </message>
    <message>
        <source>branch '%1' is the present one; go to another branch first</source>
        <translation>der Zugang „%1“ ist der jetzige; gehen Sie erst auf einen anderen</translation>
    </message>
    <message>
        <source>stroke: %~1; the file is damaged or belongs to another case</source>
        <translation>Bohrzug: %~1; die Datei ist beschädigt oder gehört zu einem anderen Fall</translation>
    </message>
    <message>
        <source>its size is not that of a stroke on this grid</source>
        <translation>seine Größe ist nicht die eines Bohrzugs auf diesem Gitter</translation>
    </message>
    <message>
        <source>it does not unpack</source>
        <translation>er lässt sich nicht entpacken</translation>
    </message>
    <message>
        <source>stroke: could not be compressed</source>
        <translation>Bohrzug: ließ sich nicht komprimieren</translation>
    </message>
    <message>
        <source>it does not begin as a stroke does</source>
        <translation>er beginnt nicht wie ein Bohrzug</translation>
    </message>
    <message>
        <source>its version is unknown</source>
        <translation>seine Version ist unbekannt</translation>
    </message>
    <message>
        <source>it is too short</source>
        <translation>er ist zu kurz</translation>
    </message>
    <message>
        <source>it names a brick that is not in the grid</source>
        <translation>er nennt einen Block, der nicht im Gitter liegt</translation>
    </message>
    <message>
        <source>it takes more than is there</source>
        <translation>er nimmt mehr, als da ist</translation>
    </message>
    <message>
        <source>it takes voxels beyond the grid</source>
        <translation>er nimmt Voxel außerhalb des Gitters</translation>
    </message>
    <message>
        <source>there is no kind of burr '%~1'; there are cutting and diamond</source>
        <translation>es gibt keine Art von Fräse „%~1“; es gibt cutting und diamond</translation>
    </message>
    <message>
        <source>'%1' cannot be a burr's name: it has a to z, 0 to 9 and hyphens, at most 40</source>
        <translation>„%1“ kann kein Name einer Fräse sein: Er besteht aus a bis z, 0 bis 9 und Bindestrichen, höchstens 40</translation>
    </message>
    <message>
        <source>burr '%1' must be of the kind of that name</source>
        <translation>Fräse „%1“ muss von der Art dieses Namens sein</translation>
    </message>
    <message>
        <source>burr '%1': 'grit_um' must be 0 to %#2 um</source>
        <translation>Fräser „%1“: „grit_um“ muss 0 bis %#2 µm sein</translation>
    </message>
    <message>
        <source>burr '%1': 'diameters_mm' must list diameters above 0 to %#2 mm</source>
        <translation>Fräse „%1“: „diameters_mm“ muss Durchmesser über 0 bis %#2 mm nennen</translation>
    </message>
    <message>
        <source>grit and wear coefficient must be above 0</source>
        <translation>Körnung und Verschleißbeiwert müssen über 0 liegen</translation>
    </message>
    <message>
        <source>there are two burrs '%1'; each needs a name of its own</source>
        <translation>es gibt zwei Fräsen „%1“; jede braucht einen eigenen Namen</translation>
    </message>
    <message>
        <source>there must be a burr '%~1', the usual one of its kind</source>
        <translation>es muss eine Fräse „%~1“ geben, die übliche ihrer Art</translation>
    </message>
    <message>
        <source>there is no burr '%1'; there are %2</source>
        <translation>es gibt keine Fräse „%1“; es gibt %2</translation>
    </message>
    <message>
        <source>the burr '%1' is a %~2 one in this catalogue, not a %~3 one</source>
        <translation>die Fräse „%1“ ist in diesem Katalog von der Art %~2, nicht %~3</translation>
    </message>
    <message>
        <source>material '%1' with the %2 burr: %~3</source>
        <translation>Material „%1“ mit der Fräse %2: %~3</translation>
    </message>
    <message>
        <source>cutting</source>
        <translation>schneidend</translation>
    </message>
    <message>
        <source>diamond</source>
        <translation>Diamant</translation>
    </message>
    <message>
        <source>a burr's name must have a to z, 0 to 9 and hyphens, at most 40</source>
        <translation>der Name einer Fräse muss aus a bis z, 0 bis 9 und Bindestrichen bestehen, höchstens 40</translation>
    </message>
    <message>
        <source>not a catalogue</source>
        <translation>kein Katalog</translation>
    </message>
    <message>
        <source>material '%1': '%2' must be above 0, it is %3</source>
        <translation>Material „%1“: „%2“ muss über 0 liegen, es ist %3</translation>
    </message>
    <message>
        <source>a material has an empty name</source>
        <translation>ein Material hat einen leeren Namen</translation>
    </message>
    <message>
        <source>material '%1' stands there twice</source>
        <translation>das Material „%1“ steht zweimal da</translation>
    </message>
    <message>
        <source>bone: 'from_hu' must lie below 'to_hu'</source>
        <translation>Knochen: „from_hu“ muss unter „to_hu“ liegen</translation>
    </message>
    <message>
        <source>there is no material '%1'; there are %2</source>
        <translation>es gibt kein Material „%1“; es gibt %2</translation>
    </message>
    <message>
        <source>%1, line %#2: %~3</source>
        <translation>%1, Zeile %#2: %~3</translation>
    </message>
    <message>
        <source>a position must lie within 1e6 mm</source>
        <translation>eine Lage muss innerhalb von 1e6 mm liegen</translation>
    </message>
    <message>
        <source>the quaternion qw,qx,qy,qz is zero or huge; it should have length 1</source>
        <translation>das Quaternion qw,qx,qy,qz ist null oder riesig; es soll die Länge 1 haben</translation>
    </message>
    <message>
        <source>drill must be 0 or 1</source>
        <translation>drill muss 0 oder 1 sein</translation>
    </message>
    <message>
        <source>time must rise from row to row</source>
        <translation>die Zeit muss von Zeile zu Zeile steigen</translation>
    </message>
    <message>
        <source>tool path: the tick rate must be above 0 Hz</source>
        <translation>Werkzeugweg: Die Taktrate muss über 0 Hz liegen</translation>
    </message>
    <message>
        <source>tool path: lasts %#1 s, which is more than 1e8 ticks; cut it into parts</source>
        <translation>Werkzeugweg: dauert %#1 s, das sind mehr als 1e8 Takte; teilen Sie ihn</translation>
    </message>
</context>
<context>
    <name>Haptics</name>
    <message>
        <source>device guard: %~1</source>
        <translation>Gerätewächter: %~1</translation>
    </message>
    <message>
        <source>The device works.</source>
        <translation>Das Gerät arbeitet.</translation>
    </message>
    <message>
        <source>The device works; it sent nothing new in this tick.</source>
        <translation>Das Gerät arbeitet; in diesem Takt sandte es nichts Neues.</translation>
    </message>
    <message>
        <source>The device is back; the force returns when it has been steady for a moment.</source>
        <translation>Das Gerät ist wieder da; die Kraft kehrt zurück, wenn es einen Augenblick ruhig war.</translation>
    </message>
    <message>
        <source>The device is connected and has sent nothing yet.</source>
        <translation>Das Gerät ist verbunden und hat noch nichts gesendet.</translation>
    </message>
    <message>
        <source>The device sent a position or time that is not a number.</source>
        <translation>Das Gerät sandte eine Lage oder Zeit, die keine Zahl ist.</translation>
    </message>
    <message>
        <source>The device sent an invalid rotation.</source>
        <translation>Das Gerät sandte eine ungültige Drehung.</translation>
    </message>
    <message>
        <source>The device sent a position farther away than any hand reaches.</source>
        <translation>Das Gerät sandte eine Lage, die keine Hand erreicht.</translation>
    </message>
    <message>
        <source>The device's clock went back.</source>
        <translation>Die Uhr des Geräts lief zurück.</translation>
    </message>
    <message>
        <source>The device's clock is ahead of the computer's.</source>
        <translation>Die Uhr des Geräts geht der des Rechners voraus.</translation>
    </message>
    <message>
        <source>The device has sent nothing new for too long.</source>
        <translation>Das Gerät hat zu lange nichts Neues gesendet.</translation>
    </message>
    <message>
        <source>The device's handle jumped, faster than a hand moves.</source>
        <translation>Der Griff des Geräts sprang, schneller als eine Hand.</translation>
    </message>
    <message>
        <source>The device is not connected.</source>
        <translation>Das Gerät ist nicht verbunden.</translation>
    </message>
    <message>
        <source>The device reports a fault.</source>
        <translation>Das Gerät meldet einen Fehler.</translation>
    </message>
    <message>
        <source>The device is in an unknown state.</source>
        <translation>Das Gerät ist in einem unbekannten Zustand.</translation>
    </message>
    <message>
        <source>The device's handle jumped by %#1 mm from one reading to the next, faster than a hand moves.</source>
        <translation>Der Griff des Geräts sprang von einer Ablesung zur nächsten um %#1 mm, schneller als eine Hand.</translation>
    </message>
    <message>
        <source>The device has sent nothing new for %#1 ms.</source>
        <translation>Das Gerät hat seit %#1 ms nichts Neues gesendet.</translation>
    </message>
    <message>
        <source>The device's clock went back by %#1 ms.</source>
        <translation>Die Uhr des Geräts lief um %#1 ms zurück.</translation>
    </message>
    <message>
        <source>The device's clock is %#1 ms ahead of the computer's.</source>
        <translation>Die Uhr des Geräts geht der des Rechners um %#1 ms voraus.</translation>
    </message>
    <message>
        <source>The device sent an invalid rotation: its quaternion's length is %#1.</source>
        <translation>Das Gerät sandte eine ungültige Drehung: Die Länge des Quaternions ist %#1.</translation>
    </message>
    <message>
        <source>The device sent a position %#1 mm away, farther than any hand reaches.</source>
        <translation>Das Gerät sandte eine Lage in %#1 mm Entfernung, die keine Hand erreicht.</translation>
    </message>
    <message>
        <source>instrument: a shell has 200 to 20000 points, not %#1</source>
        <translation>Instrument: Eine Hülle hat 200 bis 20000 Punkte, nicht %#1</translation>
    </message>
    <message>
        <source>instrument: its surface has no area</source>
        <translation>Instrument: Die Oberfläche hat keine Fläche</translation>
    </message>
</context>
<context>
    <name>Imaging</name>
    <message>
        <source>written from voxels and geometry alone</source>
        <translation>nur aus Voxeln und Geometrie geschrieben</translation>
    </message>
    <message>
        <source>DICOM: the %~1 is no UID (digits and dots, at most 64)</source>
        <translation>DICOM: %~1 ist keine UID (Ziffern und Punkte, höchstens 64)</translation>
    </message>
    <message>
        <source>%1: cannot be encoded</source>
        <translation>%1: lässt sich nicht kodieren</translation>
    </message>
    <message>
        <source>is cut short</source>
        <translation>ist abgeschnitten</translation>
    </message>
    <message>
        <source>holds fewer pixels than its header says</source>
        <translation>enthält weniger Pixel, als der Header sagt</translation>
    </message>
    <message>
        <source>could not be read: the disk or medium reports an error</source>
        <translation>ließ sich nicht lesen: Der Datenträger meldet einen Fehler</translation>
    </message>
    <message>
        <source>states a rescale slope and intercept that cannot be</source>
        <translation>nennt eine unmögliche Rescale Slope und Intercept</translation>
    </message>
    <message>
        <source>contradicts itself about the bits of a pixel</source>
        <translation>widerspricht sich bei den Bits eines Pixels</translation>
    </message>
    <message>
        <source>is compressed in a way that cannot be read</source>
        <translation>ist auf eine nicht lesbare Weise komprimiert</translation>
    </message>
    <message>
        <source>has pixels of an unusual number of bits</source>
        <translation>hat Pixel mit einer ungewöhnlichen Zahl von Bits</translation>
    </message>
    <message>
        <source>is compressed, but does not say how</source>
        <translation>ist komprimiert, sagt aber nicht, wie</translation>
    </message>
    <message>
        <source>says it is compressed, but is not</source>
        <translation>nennt sich komprimiert, ist es aber nicht</translation>
    </message>
    <message>
        <source>does not say by a slope and an intercept what its values mean (real world value mapping)</source>
        <translation>sagt nicht durch Slope und Intercept, was die Werte bedeuten (Real World Value Mapping)</translation>
    </message>
    <message>
        <source>says in several ways what its values mean (real world value mappings)</source>
        <translation>sagt auf mehrere Weisen, was die Werte bedeuten (Real World Value Mappings)</translation>
    </message>
    <message>
        <source>contradicts itself about how many frames it holds: %#1 (Number of Frames), and %#2 (Per-Frame Functional Groups Sequence)</source>
        <translation>widerspricht sich darin, wie viele Bilder sie enthält: %#1 (Number of Frames) und %#2 (Per-Frame Functional Groups Sequence)</translation>
    </message>
    <message>
        <source>states place or values twice, for all frames and for one, and they differ</source>
        <translation>gibt Ort oder Werte zweimal an, für alle Bilder und für eines, und sie sind verschieden</translation>
    </message>
    <message>
        <source>is a curved reformat (Volume Based Calculation Technique), whose pixels lie on no straight grid</source>
        <translation>ist eine gekrümmte Rekonstruktion (Volume Based Calculation Technique), deren Pixel auf keinem geraden Gitter liegen</translation>
    </message>
    <message>
        <source>is cut short or damaged</source>
        <translation>ist abgeschnitten oder beschädigt</translation>
    </message>
    <message>
        <source>holds no pixels</source>
        <translation>enthält keine Pixel</translation>
    </message>
    <message>
        <source>is empty</source>
        <translation>ist leer</translation>
    </message>
    <message>
        <source>cannot be opened</source>
        <translation>lässt sich nicht öffnen</translation>
    </message>
    <message>
        <source>Values were rounded to 32-bit floating point, by up to %#1.</source>
        <translation>Werte wurden auf 32-Bit-Gleitkommazahlen gerundet, um bis zu %#1.</translation>
    </message>
    <message>
        <source>The header calls the value %1 padding, but it does not fill the corners of any slice; it is kept as an ordinary value.</source>
        <translation>Der Header nennt den Wert %1 Padding, er füllt aber in keiner Schicht die Ecken; er bleibt ein gewöhnlicher Wert.</translation>
    </message>
    <message>
        <source>Padding had the value %1, which would pass for tissue; it was replaced by %#2.</source>
        <translation>Das Padding hatte den Wert %1, der als Gewebe gälte; er wurde durch %#2 ersetzt.</translation>
    </message>
    <message>
        <source>Of %#1 slices %#2 says that the pixels are unsigned, the others that they are signed; no value depends on it.</source>
        <translation>Von %#1 Schichten gibt %#2 die Bildpunkte ohne Vorzeichen an, die anderen mit; kein Wert hängt davon ab.</translation>
    </message>
    <message>
        <source>Of %#1 slices %#2 say that the pixels are unsigned, the others that they are signed; no value depends on it.</source>
        <translation>Von %#1 Schichten geben %#2 die Bildpunkte ohne Vorzeichen an, die anderen mit; kein Wert hängt davon ab.</translation>
    </message>
    <message>
        <source>Values whose highest stored bit is set were read as negative, as the header says (signed, Bits Stored %#1); no bit above tells them from positive ones that are too large. Look whether metal shows as air.</source>
        <translation>Werte mit gesetztem höchstem Bit wurden als negativ gelesen, wie der Header sagt (mit Vorzeichen, Bits Stored %#1); kein Bit darüber unterscheidet sie von zu großen positiven. Sehen Sie nach, ob Metall als Luft erscheint.</translation>
    </message>
    <message>
        <source>reading slices</source>
        <translation>Schichten werden gelesen</translation>
    </message>
    <message>
        <source>%#1 pixel has bits beside those stored that the file does not declare (Bits Stored); they were kept, as if stored, as asked. Look whether air or tissue shows as metal there.</source>
        <translation>%#1 Pixel hat Bits neben den gespeicherten, die die Datei nicht erklärt (Bits Stored); sie wurden wie verlangt behalten, als wären sie gespeichert. Sehen Sie nach, ob dort Luft oder Gewebe als Metall erscheint.</translation>
    </message>
    <message>
        <source>%#1 pixel has bits beside those stored that the file does not declare (Bits Stored); they were left out, as DICOM says. Look whether metal shows as tissue or air there.</source>
        <translation>%#1 Pixel hat Bits neben den gespeicherten, die die Datei nicht erklärt (Bits Stored); sie wurden weggelassen, wie DICOM es vorsieht. Sehen Sie nach, ob dort Metall als Gewebe oder Luft erscheint.</translation>
    </message>
    <message>
        <source>%#1 pixels have bits beside those stored that the file does not declare (Bits Stored); they were kept, as if stored, as asked. Look whether air or tissue shows as metal there.</source>
        <translation>%#1 Pixel haben Bits neben den gespeicherten, die die Datei nicht erklärt (Bits Stored); sie wurden wie verlangt behalten, als wären sie gespeichert. Sehen Sie nach, ob dort Luft oder Gewebe als Metall erscheint.</translation>
    </message>
    <message>
        <source>%#1 pixels have bits beside those stored that the file does not declare (Bits Stored); they were left out, as DICOM says. Look whether metal shows as tissue or air there.</source>
        <translation>%#1 Pixel haben Bits neben den gespeicherten, die die Datei nicht erklärt (Bits Stored); sie wurden weggelassen, wie DICOM es vorsieht. Sehen Sie nach, ob dort Metall als Gewebe oder Luft erscheint.</translation>
    </message>
    <message>
        <source>Left out, as DICOM says of bits that are not stored (--bits stored), the values are %~1; kept, for metal in a file whose header is wrong (--bits allocated), they are %~2</source>
        <translation>Ohne sie, wie DICOM es für nicht gespeicherte Bits vorsieht, sind die Werte %~1; mit ihnen, für Metall in einer Datei mit falschem Header, sind sie %~2</translation>
    </message>
    <message>
        <source>They can be left out, as DICOM says of bits that are not stored (--bits stored), but not kept: no copies of the sign tell negative values, such as air, from metal, and air would turn into metal</source>
        <translation>Man kann sie weglassen, wie DICOM es bei nicht gespeicherten Bits vorsieht, aber nicht behalten: keine Kopien des Vorzeichens unterscheiden negative Werte, etwa Luft, von Metall, und Luft würde zu Metall</translation>
    </message>
    <message>
        <source>They can be left out, as DICOM says of bits that are not stored (--bits stored), but not kept: unused bits lie below the values</source>
        <translation>Man kann sie weglassen, wie DICOM es bei nicht gespeicherten Bits vorsieht, aber nicht behalten: unter den Werten liegen unbenutzte Bits</translation>
    </message>
    <message>
        <source>beside them lies %#1 on average</source>
        <translation>daneben liegt im Mittel %#1</translation>
    </message>
    <message>
        <source>in %#1 slices</source>
        <translation>in %#1 Schichten</translation>
    </message>
    <message>
        <source>without the copies of the sign that the negative values of %1 have</source>
        <translation>ohne die Kopien des Vorzeichens, die die negativen Werte von %1 haben</translation>
    </message>
    <message>
        <source>some without the copies of the sign that the negative values of %1 have</source>
        <translation>einige ohne die Kopien des Vorzeichens, die die negativen Werte von %1 haben</translation>
    </message>
    <message>
        <source>%~1, and nothing says what they are. %~2. Or export it again, uncompressed and with all bits</source>
        <translation>%~1, und nichts sagt, was sie sind. %~2. Oder exportieren Sie neu, unkomprimiert und mit allen Bits</translation>
    </message>
    <message>
        <source>%#1 to %#2</source>
        <translation>%#1 bis %#2</translation>
    </message>
    <message>
        <source>%1 holds values that are not finite numbers (NaN, infinite or beyond float); give them the value of what lies outside the scanned field, such as -1024 in a CT</source>
        <translation>%1 enthält Werte, die keine endlichen Zahlen sind (NaN, unendlich oder zu groß); geben Sie ihnen den Wert dessen, was außerhalb des Messfeldes liegt, etwa -1024 im CT</translation>
    </message>
    <message>
        <source>the box asked for (%~1 mm) does not meet the image (%~2 mm, patient LPS)</source>
        <translation>der gewünschte Bereich (%~1 mm) trifft das Bild nicht (%~2 mm, LPS des Patienten)</translation>
    </message>
    <message>
        <source>series %1: %#2 x %#3 x %#4 voxels, of which the region need %#5 of memory, and %#6 are free; repair reads all of it, so close other programs</source>
        <translation>Serie %1: %#2 x %#3 x %#4 Voxel, deren Bereich %#5 Speicher braucht, %#6 sind frei; die Reparatur liest alle Schichten, schließen Sie deshalb andere Programme</translation>
    </message>
    <message>
        <source>series %1: %#2 x %#3 x %#4 voxels, of which the region need %#5 of memory, and %#6 are free; choose a smaller region of it (--roi)</source>
        <translation>Serie %1: %#2 x %#3 x %#4 Voxel, deren Bereich %#5 Speicher braucht, %#6 sind frei; wählen Sie einen kleineren Bereich</translation>
    </message>
    <message>
        <source>series %1: %#2 x %#3 x %#4 voxels need %#5 of memory, and %#6 are free; repair reads all of it, so close other programs</source>
        <translation>Serie %1: %#2 x %#3 x %#4 Voxel brauchen %#5 Speicher, %#6 sind frei; die Reparatur liest alle Schichten, schließen Sie deshalb andere Programme</translation>
    </message>
    <message>
        <source>series %1: %#2 x %#3 x %#4 voxels need %#5 of memory, and %#6 are free; choose a region of it (--roi)</source>
        <translation>Serie %1: %#2 x %#3 x %#4 Voxel brauchen %#5 Speicher, %#6 sind frei; wählen Sie einen Bereich</translation>
    </message>
    <message>
        <source>series %1</source>
        <translation>Serie %1</translation>
    </message>
    <message>
        <source>it holds no slices that make a volume</source>
        <translation>sie enthält keine Schichten, die ein Volumen ergeben</translation>
    </message>
    <message>
        <source>scan of the DICOM files</source>
        <translation>die DICOM-Dateien werden durchgesehen</translation>
    </message>
    <message>
        <source>may not be opened</source>
        <translation>darf nicht geöffnet werden</translation>
    </message>
    <message>
        <source>is a link to nothing</source>
        <translation>ist eine Verknüpfung ins Leere</translation>
    </message>
    <message>
        <source>The link '%1' leads to a folder elsewhere and was not followed; name that folder itself where its files are wanted.</source>
        <translation>Die Verknüpfung „%1“ führt in einen anderen Ordner, und ihr wurde nicht gefolgt; nennen Sie diesen Ordner selbst, wenn seine Dateien gewünscht sind.</translation>
    </message>
    <message>
        <source>'%1' is not an ordinary file (a pipe or a device) and was not read.</source>
        <translation>„%1“ ist keine gewöhnliche Datei (eine Pipe oder ein Gerät) und wurde nicht gelesen.</translation>
    </message>
    <message>
        <source>The folder '%1' may not be read; slices in it are missing. Its access rights must allow this user to read it, or name a folder without it.</source>
        <translation>Der Ordner „%1“ darf nicht gelesen werden; Schichten darin fehlen. Seine Zugriffsrechte müssen Ihnen das Lesen erlauben, oder nennen Sie einen Ordner ohne ihn.</translation>
    </message>
    <message>
        <source>%~1 It may be a slice of any series in its folder.</source>
        <translation>%~1 Es kann eine Schicht irgendeiner Serie in diesem Ordner sein.</translation>
    </message>
    <message>
        <source>It may be a slice of this series: copy it again from where it came from, or take it out of the folder if it is none.</source>
        <translation>Es kann eine Schicht dieser Serie sein: Kopieren Sie die Datei noch einmal vom Ursprung, oder nehmen Sie sie aus dem Ordner, wenn sie keine ist.</translation>
    </message>
    <message>
        <source>comparing slices</source>
        <translation>Schichten werden verglichen</translation>
    </message>
    <message>
        <source>%#1 slice is turned against the stacks of the series, of another size or beside them, too few for a stack.</source>
        <translation>%#1 Schicht ist gegen die Stapel der Serie gedreht, von anderer Größe oder neben ihnen, zu wenig für einen Stapel.</translation>
    </message>
    <message>
        <source>%#1 slices are turned against the stacks of the series, of another size or beside them, too few for a stack.</source>
        <translation>%#1 Schichten sind gegen die Stapel der Serie gedreht, von anderer Größe oder neben ihnen, zu wenige für einen Stapel.</translation>
    </message>
    <message>
        <source>%#1 slice of the series is turned against its stacks, of another size or beside them, too few for a stack, and set aside.</source>
        <translation>%#1 Schicht der Serie ist gegen ihre Stapel gedreht, von anderer Größe oder neben ihnen, zu wenig für einen Stapel, und beiseitegelegt.</translation>
    </message>
    <message>
        <source>%#1 slices of the series are turned against its stacks, of another size or beside them, too few for a stack, and set aside.</source>
        <translation>%#1 Schichten der Serie sind gegen ihre Stapel gedreht, von anderer Größe oder neben ihnen, zu wenige für einen Stapel, und beiseitegelegt.</translation>
    </message>
    <message>
        <source>The header states %#1 images, and %#2 are there</source>
        <translation>Der Header nennt %#1 Bilder, und %#2 sind da</translation>
    </message>
    <message>
        <source>The slices are numbered from %#1 to %#2</source>
        <translation>Die Schichten sind von %#1 bis %#2 nummeriert</translation>
    </message>
    <message>
        <source>numbered from %#1 to %#2</source>
        <translation>nummeriert von %#1 bis %#2</translation>
    </message>
    <message>
        <source>%~1; slices may be missing, also at its ends. Look whether all of the skull base that is needed is there.</source>
        <translation>%~1; Schichten können fehlen, auch an seinen Enden. Sehen Sie nach, ob die ganze benötigte Schädelbasis da ist.</translation>
    </message>
    <message>
        <source>%~1; the stack has no gap, but its ends may be missing. Look whether all of the skull base that is needed is there.</source>
        <translation>%~1; der Stapel hat keine Lücke, aber seine Enden können fehlen. Sehen Sie nach, ob die ganze benötigte Schädelbasis da ist.</translation>
    </message>
    <message>
        <source>The slices are %#1 mm thick and stand %#2 mm apart: %#3 mm from each to the next were not measured.</source>
        <translation>Die Schichten sind %#1 mm dick und stehen %#2 mm auseinander: %#3 mm von jeder zur nächsten wurden nicht gemessen.</translation>
    </message>
    <message>
        <source>The slices are numbered in steps of %#1 and are %#2 mm thick, but stand %#3 mm apart: those between them may be missing, and %#4 mm from each to the next were not measured. Look whether the series has more files.</source>
        <translation>Die Schichten sind in Schritten von %#1 nummeriert und %#2 mm dick, stehen aber %#3 mm auseinander: Die dazwischen können fehlen, und %#4 mm von jeder zur nächsten wurden nicht gemessen. Sehen Sie nach, ob die Serie weitere Dateien hat.</translation>
    </message>
    <message>
        <source>%#1 mm (%#2 slice)</source>
        <translation>%#1 mm (%#2 Schicht)</translation>
    </message>
    <message>
        <source>%#1 mm (%#2 slices)</source>
        <translation>%#1 mm (%#2 Schichten)</translation>
    </message>
    <message>
        <source>Another volume of the series goes on for %~1 before the first slice of this one and %~2 beyond its last slice; the stack has no gap, but its ends may be missing. Look whether all of the skull base that is needed is there.</source>
        <translation>Ein anderes Volumen der Serie reicht %~1 vor die erste Schicht von diesem und %~2 hinter seine letzte; der Stapel hat keine Lücke, aber seine Enden können fehlen. Sehen Sie nach, ob die ganze benötigte Schädelbasis da ist.</translation>
    </message>
    <message>
        <source>Another volume of the series goes on for %~1 before the first slice of this one%~2 beyond its last slice; the stack has no gap, but its ends may be missing. Look whether all of the skull base that is needed is there.</source>
        <translation>Ein anderes Volumen der Serie reicht %~1 vor die erste Schicht von diesem%~2 hinter seine letzte; der Stapel hat keine Lücke, aber seine Enden können fehlen. Sehen Sie nach, ob die ganze benötigte Schädelbasis da ist.</translation>
    </message>
    <message>
        <source>Another volume of the series goes on for %~1 before the first slice of this one; the stack has no gap, but its ends may be missing. Look whether all of the skull base that is needed is there.</source>
        <translation>Ein anderes Volumen der Serie reicht %~1 vor die erste Schicht von diesem; der Stapel hat keine Lücke, aber seine Enden können fehlen. Sehen Sie nach, ob die ganze benötigte Schädelbasis da ist.</translation>
    </message>
    <message>
        <source>Another volume of the series goes on for %~1 beyond its last slice; the stack has no gap, but its ends may be missing. Look whether all of the skull base that is needed is there.</source>
        <translation>Ein anderes Volumen der Serie reicht %~1 hinter die letzte Schicht von diesem; der Stapel hat keine Lücke, aber seine Enden können fehlen. Sehen Sie nach, ob die ganze benötigte Schädelbasis da ist.</translation>
    </message>
    <message>
        <source>The header states %#1 images of the series, and %#2 are there in all its volumes, which are equally long; a volume or the ends of all may be missing. Look whether all of the skull base that is needed is there.</source>
        <translation>Der Header nennt %#1 Bilder der Serie, und %#2 sind in allen ihren Volumen da, die gleich lang sind; ein Volumen oder die Enden aller können fehlen. Sehen Sie nach, ob die ganze benötigte Schädelbasis da ist.</translation>
    </message>
    <message>
        <source>Those at one place have equal pixels, so that one of each can be kept.</source>
        <translation>Die an einem Ort haben gleiche Pixel, sodass von jeder eine bleiben kann.</translation>
    </message>
    <message>
        <source>They show different things, in up to %#1 of %#2 voxels of a slice, so none of them can be left out; keep the files of one reconstruction in the folder.</source>
        <translation>Sie zeigen Verschiedenes, in bis zu %#1 von %#2 Voxeln einer Schicht, sodass keine weggelassen werden kann; lassen Sie im Ordner die Dateien einer einzigen Rekonstruktion.</translation>
    </message>
    <message>
        <source>%#1 file beside the slices cannot be read and was set aside: the slices stand without a gap and are numbered %#2 to %#3</source>
        <translation>%#1 Datei neben den Schichten ist nicht lesbar und wurde beiseitegelegt: Die Schichten stehen ohne Lücke und sind von %#2 bis %#3 nummeriert</translation>
    </message>
    <message>
        <source>%#1 files beside the slices cannot be read and were set aside: the slices stand without a gap and are numbered %#2 to %#3</source>
        <translation>%#1 Dateien neben den Schichten sind nicht lesbar und wurden beiseitegelegt: Die Schichten stehen ohne Lücke und sind von %#2 bis %#3 nummeriert</translation>
    </message>
    <message>
        <source>%~1, as many as the header states.</source>
        <translation>%~1, so viele, wie der Header nennt.</translation>
    </message>
    <message>
        <source>%~1, and with what else is in the series as many as the header states.</source>
        <translation>%~1, und mit dem, was sonst in der Serie ist, so viele, wie der Header nennt.</translation>
    </message>
    <message>
        <source>%~1. If it was a slice beyond that, the volume ends %#2 mm too early.</source>
        <translation>%~1. War sie eine Schicht jenseits davon, endet das Volumen %#2 mm zu früh.</translation>
    </message>
    <message>
        <source>%~1. If they were slices beyond that, the volume ends %#2 mm too early.</source>
        <translation>%~1. Waren sie Schichten jenseits davon, endet das Volumen %#2 mm zu früh.</translation>
    </message>
    <message>
        <source>%#1 more files in the folder cannot be read.</source>
        <translation>%#1 weitere Dateien im Ordner sind nicht lesbar.</translation>
    </message>
    <message>
        <source>%#1 file is a copy of another, byte by byte, and left out.</source>
        <translation>%#1 Datei ist eine Kopie einer anderen, Byte für Byte, und blieb weg.</translation>
    </message>
    <message>
        <source>%#1 files are copies of another, byte by byte, and left out.</source>
        <translation>%#1 Dateien sind Kopien anderer, Byte für Byte, und blieben weg.</translation>
    </message>
    <message>
        <source>%#1 damaged file was left out: the same slice is there whole.</source>
        <translation>%#1 beschädigte Datei blieb weg: Dieselbe Schicht ist unversehrt da.</translation>
    </message>
    <message>
        <source>%#1 damaged files were left out: the same slice is there whole.</source>
        <translation>%#1 beschädigte Dateien blieben weg: Dieselbe Schicht ist unversehrt da.</translation>
    </message>
    <message>
        <source>Slices at one place cannot be compared, so none of them can be left out: %~1</source>
        <translation>Schichten am selben Ort lassen sich nicht vergleichen, daher kann keine davon weggelassen werden: %~1</translation>
    </message>
    <message>
        <source>Its slices need more memory than is free, even one by one.</source>
        <translation>Ihre Schichten brauchen mehr Speicher, als frei ist, selbst einzeln.</translation>
    </message>
    <message>
        <source>%~1 It was set aside: the slices beside it are whole without it.</source>
        <translation>%~1 Sie wurde beiseitegelegt: Die Schichten daneben sind ohne sie vollständig.</translation>
    </message>
    <message>
        <source>'%1' lists %#2 files, of which %#3 is not there (the first is '%4'): slices or whole series may be missing. Copy the disc again.</source>
        <translation>„%1“ führt %#2 Dateien auf, von denen %#3 nicht da ist (die erste ist „%4“): Schichten oder ganze Serien können fehlen. Kopieren Sie den Datenträger noch einmal.</translation>
    </message>
    <message>
        <source>'%1' lists %#2 files, of which %#3 are not there (the first is '%4'): slices or whole series may be missing. Copy the disc again.</source>
        <translation>„%1“ führt %#2 Dateien auf, von denen %#3 nicht da sind (die erste ist „%4“): Schichten oder ganze Serien können fehlen. Kopieren Sie den Datenträger noch einmal.</translation>
    </message>
    <message>
        <source>The index of the disc (DICOMDIR) lists %#1 file of the series that is not there; the stack may have no gap, but slices are missing. Copy the disc again.</source>
        <translation>Das Inhaltsverzeichnis des Datenträgers (DICOMDIR) führt %#1 Datei der Serie auf, die nicht da ist; der Stapel hat vielleicht keine Lücke, aber Schichten fehlen. Kopieren Sie den Datenträger noch einmal.</translation>
    </message>
    <message>
        <source>The index of the disc (DICOMDIR) lists %#1 files of the series that are not there; the stack may have no gap, but slices are missing. Copy the disc again.</source>
        <translation>Das Inhaltsverzeichnis des Datenträgers (DICOMDIR) führt %#1 Dateien der Serie auf, die nicht da sind; der Stapel hat vielleicht keine Lücke, aber Schichten fehlen. Kopieren Sie den Datenträger noch einmal.</translation>
    </message>
    <message>
        <source>series: %#1 files, %#2 slices, %~3</source>
        <translation>Serie: %#1 Dateien, %#2 Schichten, %~3</translation>
    </message>
    <message>
        <source>%1 (%2, %#3 slices, needs --repair)</source>
        <translation>%1 (%2, %#3 Schichten, braucht Reparatur)</translation>
    </message>
    <message>
        <source>%1 (%2, %#3 slices)</source>
        <translation>%1 (%2, %#3 Schichten)</translation>
    </message>
    <message>
        <source>%1 '%2' (%3, %#4 slices, needs --repair)</source>
        <translation>%1 „%2“ (%3, %#4 Schichten, braucht Reparatur)</translation>
    </message>
    <message>
        <source>%1 '%2' (%3, %#4 slices)</source>
        <translation>%1 „%2“ (%3, %#4 Schichten)</translation>
    </message>
    <message>
        <source>%1: is neither a folder nor an ordinary file; give the folder that holds the CT's .dcm files</source>
        <translation>%1: ist weder ein Ordner noch eine gewöhnliche Datei; nennen Sie den Ordner mit den .dcm-Dateien des CT</translation>
    </message>
    <message>
        <source>%1: no such file or folder; give the folder that holds the CT's .dcm files</source>
        <translation>%1: keine solche Datei und kein solcher Ordner; nennen Sie den Ordner mit den .dcm-Dateien des CT</translation>
    </message>
    <message>
        <source>%1: the folder may not be read; its access rights must allow this user to read it</source>
        <translation>%1: der Ordner darf nicht gelesen werden; seine Zugriffsrechte müssen Ihnen das Lesen erlauben</translation>
    </message>
    <message>
        <source>is not DICOM, although it is named as a slice</source>
        <translation>ist kein DICOM, obwohl wie eine Schicht benannt</translation>
    </message>
    <message>
        <source>no image</source>
        <translation>kein Bild</translation>
    </message>
    <message>
        <source>%1: no series %2; there is %~3</source>
        <translation>%1: keine Serie %2; es gibt %~3</translation>
    </message>
    <message>
        <source>%1: no volume '%2'; there is %~3</source>
        <translation>%1: kein Volumen „%2“; es gibt %~3</translation>
    </message>
    <message>
        <source>%1: %#2 volumes; name one by --series and --volume: %3</source>
        <translation>%1: %#2 Volumen; wählen Sie eines: %3</translation>
    </message>
    <message>
        <source>%1: %#2 series; name one by --series: %3</source>
        <translation>%1: %#2 Serien; wählen Sie eine: %3</translation>
    </message>
    <message>
        <source>%1: no DICOM image that can be used: %~2 Give the folder that holds the CT's .dcm files</source>
        <translation>%1: kein verwendbares DICOM-Bild: %~2 Nennen Sie den Ordner mit den .dcm-Dateien des CT</translation>
    </message>
    <message>
        <source>%1: %~2 Copy it again from where it came from</source>
        <translation>%1: %~2 Kopieren Sie es noch einmal vom Ursprung</translation>
    </message>
    <message>
        <source>%1: no DICOM image found (%#2 other files); give the folder that holds the CT's .dcm files</source>
        <translation>%1: kein DICOM-Bild gefunden (%#2 andere Dateien); nennen Sie den Ordner mit den .dcm-Dateien des CT</translation>
    </message>
    <message>
        <source>%1 says that its pixels are signed, and other slices of the series that theirs are not (Pixel Representation): %#2 value would be another one if it is as they are. Export the series again.</source>
        <translation>%1 gibt seine Bildpunkte mit Vorzeichen an, andere Schichten der Serie ihre ohne (Pixel Representation): %#2 Wert wäre ein anderer, wenn sie wie die anderen ist. Exportieren Sie die Serie neu.</translation>
    </message>
    <message>
        <source>%1 says that its pixels are signed, and other slices of the series that theirs are not (Pixel Representation): %#2 values would be another one if it is as they are. Export the series again.</source>
        <translation>%1 gibt seine Bildpunkte mit Vorzeichen an, andere Schichten der Serie ihre ohne (Pixel Representation): %#2 Werte wären andere, wenn sie wie die anderen ist. Exportieren Sie die Serie neu.</translation>
    </message>
    <message>
        <source>%1 says that its pixels are unsigned, and other slices of the series that theirs are not (Pixel Representation): %#2 value would be another one if it is as they are. Export the series again.</source>
        <translation>%1 gibt seine Bildpunkte ohne Vorzeichen an, andere Schichten der Serie ihre mit (Pixel Representation): %#2 Wert wäre ein anderer, wenn sie wie die anderen ist. Exportieren Sie die Serie neu.</translation>
    </message>
    <message>
        <source>%1 says that its pixels are unsigned, and other slices of the series that theirs are not (Pixel Representation): %#2 values would be another one if it is as they are. Export the series again.</source>
        <translation>%1 gibt seine Bildpunkte ohne Vorzeichen an, andere Schichten der Serie ihre mit (Pixel Representation): %#2 Werte wären andere, wenn sie wie die anderen ist. Exportieren Sie die Serie neu.</translation>
    </message>
    <message>
        <source>%1 %~2; copy it again from where it came from</source>
        <translation>%1 %~2; kopieren Sie es noch einmal vom Ursprung</translation>
    </message>
    <message>
        <source>%1 was changed or replaced after its header was read; wait until the copying is done, then read the folder again</source>
        <translation>%1 wurde geändert oder ersetzt, nachdem der Header gelesen war; warten Sie, bis das Kopieren beendet ist, und lesen Sie den Ordner dann neu</translation>
    </message>
    <message>
        <source>%~1; export it again, uncompressed and with all bits</source>
        <translation>%~1; exportieren Sie neu, unkomprimiert und mit allen Bits</translation>
    </message>
    <message>
        <source>does not say where its compressed frames begin</source>
        <translation>sagt nicht, wo die komprimierten Frames beginnen</translation>
    </message>
    <message>
        <source>does not have one pixel value of 8, 12, 16 or 32 bits</source>
        <translation>hat nicht einen Pixelwert von 8, 12, 16 oder 32 Bit</translation>
    </message>
    <message>
        <source>has a damaged compressed image</source>
        <translation>hat ein beschädigtes komprimiertes Bild</translation>
    </message>
    <message>
        <source>does not have one floating-point value of 32 or 64 bits</source>
        <translation>hat nicht einen Gleitkommawert von 32 oder 64 Bit</translation>
    </message>
    <message>
        <source>%1 contradicts itself about the bits of a pixel: %#2 pixel has values of more than the %#3 bits that its header states (Bits Stored)%~4</source>
        <translation>%1 widerspricht sich bei den Bits eines Pixels: %#2 Pixel hat einen Wert mit mehr als den %#3 Bit, die der Header nennt (Bits Stored)%~4</translation>
    </message>
    <message>
        <source>%1 contradicts itself about the bits of a pixel: %#2 pixels have values of more than the %#3 bits that its header states (Bits Stored)%~4</source>
        <translation>%1 widerspricht sich bei den Bits eines Pixels: %#2 Pixel haben Werte mit mehr als den %#3 Bit, die der Header nennt (Bits Stored)%~4</translation>
    </message>
    <message>
        <source>%1 could not be read: the disk or medium was removed or reports an error</source>
        <translation>%1 ließ sich nicht lesen: Der Datenträger wurde entfernt oder meldet einen Fehler</translation>
    </message>
    <message>
        <source>%#1 of %#2 slice</source>
        <translation>%#1 von %#2 Schicht</translation>
    </message>
    <message>
        <source>%#1 of %#2 slices</source>
        <translation>%#1 von %#2 Schichten</translation>
    </message>
    <message>
        <source>judging the slices</source>
        <translation>Schichten werden beurteilt</translation>
    </message>
    <message>
        <source>%#1 more files of the series are damaged.</source>
        <translation>%#1 weitere Dateien der Serie sind beschädigt.</translation>
    </message>
    <message>
        <source>The DICOM objects hold no pixels (a report, a structure set or the like), so they are no image.</source>
        <translation>Die DICOM-Objekte enthalten keine Pixel (ein Befund, ein Struktursatz oder dergleichen) und sind daher kein Bild.</translation>
    </message>
    <message>
        <source>%#1 DICOM objects without pixels were left out.</source>
        <translation>%#1 DICOM-Objekte ohne Pixel blieben weg.</translation>
    </message>
    <message>
        <source>%#1 file holds many frames in one that are not those of an enhanced CT or MR; a DICOM segmentation is read as structures (--labels).</source>
        <translation>%#1 Datei enthält viele Frames in einem, die nicht die eines Enhanced CT oder MR sind; eine DICOM-Segmentierung wird als Strukturen gelesen.</translation>
    </message>
    <message>
        <source>%#1 files hold many frames in one that are not those of an enhanced CT or MR; a DICOM segmentation is read as structures (--labels).</source>
        <translation>%#1 Dateien enthalten viele Frames in einem, die nicht die eines Enhanced CT oder MR sind; eine DICOM-Segmentierung wird als Strukturen gelesen.</translation>
    </message>
    <message>
        <source>%1 are pictures in colour (a report or a screenshot), and left out.</source>
        <translation>%1 sind Farbbilder (ein Befund oder Bildschirmfoto) und blieben weg.</translation>
    </message>
    <message>
        <source>Colours instead of one CT or MR value a pixel in %1.</source>
        <translation>Farben statt eines CT- oder MR-Wertes je Pixel in %1.</translation>
    </message>
    <message>
        <source>Another patient than in the rest is named in %1; keep the files of one patient in the folder.</source>
        <translation>Ein anderer Patient als im Rest ist genannt in %1; lassen Sie im Ordner die Dateien eines Patienten.</translation>
    </message>
    <message>
        <source>Another study than the rest is named in %1; keep the files of one study in the folder.</source>
        <translation>Eine andere Studie als im Rest ist genannt in %1; lassen Sie im Ordner die Dateien einer Studie.</translation>
    </message>
    <message>
        <source>No usable position, orientation and pixel spacing in %1 (%2), so nothing says where they lie in the patient.</source>
        <translation>Keine verwendbare Lage, Orientierung und Pixelgröße in %1 (%2), daher sagt nichts, wo sie im Patienten liegen.</translation>
    </message>
    <message>
        <source>Another frame of reference in %1 (%2), so their place relative to the others is unknown.</source>
        <translation>Ein anderes Bezugssystem in %1 (%2), daher ist ihre Lage zu den anderen unbekannt.</translation>
    </message>
    <message>
        <source>%#1 localizer (scout) is mixed in with the %#2 slices of the stack, and left out.</source>
        <translation>%#1 Übersichtsaufnahme (Scout) liegt zwischen den %#2 Schichten des Stapels und blieb weg.</translation>
    </message>
    <message>
        <source>%#1 localizers (scouts) are mixed in with the %#2 slices of the stack, and left out.</source>
        <translation>%#1 Übersichtsaufnahmen (Scouts) liegen zwischen den %#2 Schichten des Stapels und blieben weg.</translation>
    </message>
    <message>
        <source>%1 are turned or mirrored against the others, their rows or columns by up to %#2 degrees, within their plane; read as one stack, their corners would lie up to %#3 mm off.</source>
        <translation>%1 sind gegen die anderen gedreht oder gespiegelt, ihre Zeilen oder Spalten um bis zu %#2 Grad, in ihrer Ebene; als ein Stapel gelesen, lägen ihre Ecken bis zu %#3 mm falsch.</translation>
    </message>
    <message>
        <source>%1 are turned or mirrored against the others, their rows or columns by up to %#2 degrees, their normals by up to %#3 degrees; read as one stack, their corners would lie up to %#4 mm off.</source>
        <translation>%1 sind gegen die anderen gedreht oder gespiegelt, ihre Zeilen oder Spalten um bis zu %#2 Grad, ihre Normalen um bis zu %#3 Grad; als ein Stapel gelesen, lägen ihre Ecken bis zu %#4 mm falsch.</translation>
    </message>
    <message>
        <source>%1 are turned against the others, their rows or columns by up to %#2 degrees, within their plane; read as one stack, their corners would lie up to %#3 mm off.</source>
        <translation>%1 sind gegen die anderen gedreht, ihre Zeilen oder Spalten um bis zu %#2 Grad, in ihrer Ebene; als ein Stapel gelesen, lägen ihre Ecken bis zu %#3 mm falsch.</translation>
    </message>
    <message>
        <source>%1 are turned against the others, their rows or columns by up to %#2 degrees, their normals by up to %#3 degrees; read as one stack, their corners would lie up to %#4 mm off.</source>
        <translation>%1 sind gegen die anderen gedreht, ihre Zeilen oder Spalten um bis zu %#2 Grad, ihre Normalen um bis zu %#3 Grad; als ein Stapel gelesen, lägen ihre Ecken bis zu %#4 mm falsch.</translation>
    </message>
    <message>
        <source>within their plane</source>
        <translation>in ihrer Ebene</translation>
    </message>
    <message>
        <source>%1 have another size than %#2 x %#3 pixels of %#4 x %#5 mm: their fields of view differ by %#6 mm.</source>
        <translation>%1 haben eine andere Größe als %#2 x %#3 Pixel von %#4 x %#5 mm: Ihre Bildfelder unterscheiden sich um %#6 mm.</translation>
    </message>
    <message>
        <source>A table (Modality LUT) says what the values mean in %1, and tables are not read; export the series with rescale slope and intercept.</source>
        <translation>Eine Tabelle (Modality LUT) sagt, was die Werte bedeuten in %1, und Tabellen werden nicht gelesen; exportieren Sie die Serie mit Rescale Slope und Intercept.</translation>
    </message>
    <message>
        <source>The slices do not share one unit of their values (Rescale Type): another than that of the first is stated in %1, and no slope and intercept turns one into the other; keep the files of one in the folder.</source>
        <translation>Die Schichten haben nicht eine Einheit ihrer Werte (Rescale Type): Eine andere als die der ersten nennen %1, und keine Steigung und kein Achsenabschnitt macht aus der einen die andere; lassen Sie nur die Dateien der einen im Ordner.</translation>
    </message>
    <message>
        <source>The slices do not share one rescale slope and intercept, so equal tissue may have unequal values; no position is affected (0 mm).</source>
        <translation>Die Schichten haben nicht alle dieselbe Rescale Slope und Intercept, gleiches Gewebe kann daher ungleiche Werte haben; keine Lage ist betroffen (0 mm).</translation>
    </message>
    <message>
        <source>The header states text in the pixels (Burned In Annotation), in %1: it may name the patient; look at the image before it is handed on.</source>
        <translation>Der Header nennt Text in den Pixeln (Burned In Annotation), in %1: Er kann den Patienten nennen; sehen Sie das Bild an, bevor es weitergegeben wird.</translation>
    </message>
    <message>
        <source>Text may be in the pixels, as of a screenshot or a converted image, in %1: it may name the patient; look at the image before it is handed on.</source>
        <translation>In den Pixeln kann Text sein, wie in einem Bildschirmfoto oder umgewandelten Bild, in %1: Er kann den Patienten nennen; sehen Sie das Bild an, bevor es weitergegeben wird.</translation>
    </message>
    <message>
        <source>The header states text in the pixels (Burned In Annotation), in</source>
        <translation>Der Header nennt Text in den Pixeln (Burned In Annotation), in</translation>
    </message>
    <message>
        <source>Whether they were compressed with loss cannot be told of %1, as neither the header nor the compressed image says it.</source>
        <translation>Ob verlustbehaftet komprimiert wurde, lässt sich nicht sagen bei %1, da weder Header noch komprimiertes Bild es nennen.</translation>
    </message>
    <message>
        <source>Compressed with loss, to 1/%#1 of the size, in %2: values are not those measured, and thin walls may be blurred; the archive may have the series without loss.</source>
        <translation>Verlustbehaftet komprimiert, auf 1/%#1 der Größe, in %2: Die Werte sind nicht die gemessenen, und dünne Wände können verwischt sein; vielleicht hat das Archiv die Serie ohne Verlust.</translation>
    </message>
    <message>
        <source>Compressed with loss, in %1: values are not those measured, and thin walls may be blurred; the archive may have the series without loss.</source>
        <translation>Verlustbehaftet komprimiert, in %1: Die Werte sind nicht die gemessenen, und dünne Wände können verwischt sein; vielleicht hat das Archiv die Serie ohne Verlust.</translation>
    </message>
    <message>
        <source>series numbers</source>
        <translation>Seriennummern</translation>
    </message>
    <message>
        <source>reconstruction kernels</source>
        <translation>Rekonstruktionskerne</translation>
    </message>
    <message>
        <source>tube voltages</source>
        <translation>Röhrenspannungen</translation>
    </message>
    <message>
        <source>acquisitions that take turns along the stack</source>
        <translation>Aufnahmen, die entlang des Stapels abwechseln</translation>
    </message>
    <message>
        <source>The slices are of several scans or reconstructions: they differ in %~1, so neighbours may show equal tissue unequally and at different times; keep the files of one in the folder.</source>
        <translation>Die Schichten stammen aus mehreren Aufnahmen oder Rekonstruktionen: Sie unterscheiden sich durch %~1, Nachbarn können gleiches Gewebe daher ungleich und zu verschiedenen Zeiten zeigen; lassen Sie im Ordner die Dateien einer einzigen.</translation>
    </message>
    <message>
        <source>Slices %#1 and %#2 were acquired %#3 minutes apart. If the patient moved meanwhile there is a step between them that no patient has: look at bone that goes through.</source>
        <translation>Die Schichten %#1 und %#2 wurden im Abstand von %#3 Minuten aufgenommen. Hat sich der Patient dazwischen bewegt, so liegt zwischen ihnen eine Stufe, die kein Patient hat: Sehen Sie nach an Knochen, der hindurchgeht.</translation>
    </message>
    <message>
        <source>There is no slice.</source>
        <translation>Es gibt keine Schicht.</translation>
    </message>
    <message>
        <source>One slice alone has no thickness that its position could show; a stack of at least 2 slices is needed.</source>
        <translation>Eine einzelne Schicht hat keine Dicke, die ihre Lage zeigen könnte; ein Stapel aus mindestens 2 Schichten ist nötig.</translation>
    </message>
    <message>
        <source>The slices' positions do not make a grid.</source>
        <translation>Die Lagen der Schichten ergeben kein Gitter.</translation>
    </message>
    <message>
        <source>unreadable</source>
        <translation>nicht lesbar</translation>
    </message>
    <message>
        <source>ok</source>
        <translation>in Ordnung</translation>
    </message>
    <message>
        <source>repairable</source>
        <translation>reparierbar</translation>
    </message>
    <message>
        <source>refused</source>
        <translation>abgelehnt</translation>
    </message>
    <message>
        <source>Repaired: of slices at one place, whose pixels are equal, the first was kept, and %#1 left out.</source>
        <translation>Repariert: Von Schichten an einem Ort, deren Pixel gleich sind, blieb die erste, und %#1 blieben weg.</translation>
    </message>
    <message>
        <source>Repaired: the gantry's tilt of %#1 degrees was undone by shifting each slice to where its position puts it, the last by %#2 mm against the first.</source>
        <translation>Repariert: Die Gantry-Neigung von %#1 Grad wurde rückgängig gemacht, indem jede Schicht an ihre Lage verschoben wurde, die letzte um %#2 mm gegen die erste.</translation>
    </message>
    <message>
        <source>Repaired: slices were shifted sideways to where their positions put them, by up to %#1 mm against the first.</source>
        <translation>Repariert: Schichten wurden seitlich an ihre Lage verschoben, um bis zu %#1 mm gegen die erste.</translation>
    </message>
    <message>
        <source>Repaired: each slice's own rescale slope and intercept were applied.</source>
        <translation>Repariert: Rescale Slope und Intercept jeder einzelnen Schicht wurden angewandt.</translation>
    </message>
    <message>
        <source>Repaired: slice %1 of %#2 was interpolated between neighbours before the series was written; small structures may be absent there.</source>
        <translation>Repariert: Schicht %1 von %#2 wurde zwischen Nachbarn interpoliert, bevor die Serie geschrieben wurde; kleine Strukturen können dort fehlen.</translation>
    </message>
    <message>
        <source>Repaired: slices %1 of %#2 were interpolated between neighbours before the series was written; small structures may be absent there.</source>
        <translation>Repariert: Schichten %1 von %#2 wurden zwischen Nachbarn interpoliert, bevor die Serie geschrieben wurde; kleine Strukturen können dort fehlen.</translation>
    </message>
    <message>
        <source>Repaired: slice %~1 of %#2 is missing from the files and was interpolated between neighbours, up to %#3 mm from what was measured; small structures may be absent there.</source>
        <translation>Repariert: Schicht %~1 von %#2 fehlt in den Dateien und wurde zwischen Nachbarn interpoliert, bis zu %#3 mm vom Gemessenen; kleine Strukturen können dort fehlen.</translation>
    </message>
    <message>
        <source>Repaired: slice %~1 of %#2 were in part interpolated between neighbours, up to %#3 mm from what was measured; small structures may be absent there.</source>
        <translation>Repariert: Schicht %~1 von %#2 wurde teilweise zwischen Nachbarn interpoliert, bis zu %#3 mm vom Gemessenen; kleine Strukturen können dort fehlen.</translation>
    </message>
    <message>
        <source>Repaired: slice %~1 of %#2 was interpolated between neighbours, up to %#3 mm from what was measured; small structures may be absent there.</source>
        <translation>Repariert: Schicht %~1 von %#2 wurde zwischen Nachbarn interpoliert, bis zu %#3 mm vom Gemessenen; kleine Strukturen können dort fehlen.</translation>
    </message>
    <message>
        <source>Repaired: slices %~1 of %#2 are missing and were interpolated between neighbours, up to %#3 mm from what was measured; small structures may be absent there.</source>
        <translation>Repariert: Schichten %~1 von %#2 fehlen und wurden zwischen Nachbarn interpoliert, bis zu %#3 mm vom Gemessenen; kleine Strukturen können dort fehlen.</translation>
    </message>
    <message>
        <source>Repaired: slices %~1 of %#2 were in part interpolated between neighbours, up to %#3 mm from what was measured; small structures may be absent there.</source>
        <translation>Repariert: Schichten %~1 von %#2 wurden teilweise zwischen Nachbarn interpoliert, bis zu %#3 mm vom Gemessenen; kleine Strukturen können dort fehlen.</translation>
    </message>
    <message>
        <source>Repaired: slices %~1 of %#2 were interpolated between neighbours, up to %#3 mm from what was measured; small structures may be absent there.</source>
        <translation>Repariert: Schichten %~1 von %#2 wurden zwischen Nachbarn interpoliert, bis zu %#3 mm vom Gemessenen; kleine Strukturen können dort fehlen.</translation>
    </message>
    <message>
        <source>Repaired: %#1 of %#2 measured slices lies between those of the volume, %#3 mm apart, and makes up less than half of any; small structures may be absent there.</source>
        <translation>Repariert: %#1 von %#2 gemessenen Schichten liegt zwischen denen des Volumens, %#3 mm auseinander, und macht weniger als die Hälfte einer jeden aus; kleine Strukturen können dort fehlen.</translation>
    </message>
    <message>
        <source>Repaired: %#1 of %#2 measured slices lie between those of the volume, %#3 mm apart, and make up less than half of any; small structures may be absent there.</source>
        <translation>Repariert: %#1 von %#2 gemessenen Schichten liegen zwischen denen des Volumens, %#3 mm auseinander, und machen weniger als die Hälfte einer jeden aus; kleine Strukturen können dort fehlen.</translation>
    </message>
    <message>
        <source>straightening the slices</source>
        <translation>Schichten werden gerade gestellt</translation>
    </message>
    <message>
        <source>echo time</source>
        <translation>Echozeit</translation>
    </message>
    <message>
        <source>trigger time</source>
        <translation>Triggerzeit</translation>
    </message>
    <message>
        <source>inversion time</source>
        <translation>Inversionszeit</translation>
    </message>
    <message>
        <source>series number</source>
        <translation>Seriennummer</translation>
    </message>
    <message>
        <source>no gradient</source>
        <translation>ohne Gradient</translation>
    </message>
    <message>
        <source>gradient %#1</source>
        <translation>Gradient %#1</translation>
    </message>
    <message>
        <source>repeat %#1</source>
        <translation>Wiederholung %#1</translation>
    </message>
    <message>
        <source>set aside</source>
        <translation>beiseitegelegt</translation>
    </message>
    <message>
        <source>farthest %~1</source>
        <translation>am weitesten %~1</translation>
    </message>
    <message>
        <source>farther %~1</source>
        <translation>weiter %~1</translation>
    </message>
    <message>
        <source>%#1 of %#2 from the %~3</source>
        <translation>%#1 von %#2 ab %~3</translation>
    </message>
    <message>
        <source>tilt %1</source>
        <translation>Neigung %1</translation>
    </message>
    <message>
        <source>between %#1 and %#2 mm</source>
        <translation>zwischen %#1 und %#2 mm</translation>
    </message>
    <message>
        <source>and elsewhere</source>
        <translation>und anderswo</translation>
    </message>
    <message>
        <source>%#1 of %#2 slices lies beside another at the same height, up to %#3 mm away, as of reconstructions of either ear: they are not of one stack; keep the files of one in the folder.</source>
        <translation>%#1 von %#2 Schichten liegt neben einer anderen auf gleicher Höhe, bis zu %#3 mm entfernt, wie bei Rekonstruktionen der beiden Ohren: Sie sind nicht aus einem Stapel; lassen Sie im Ordner die Dateien eines einzigen.</translation>
    </message>
    <message>
        <source>%#1 of %#2 slices lie beside another at the same height, up to %#3 mm away, as of reconstructions of either ear: they are not of one stack; keep the files of one in the folder.</source>
        <translation>%#1 von %#2 Schichten liegen neben einer anderen auf gleicher Höhe, bis zu %#3 mm entfernt, wie bei Rekonstruktionen der beiden Ohren: Sie sind nicht aus einem Stapel; lassen Sie im Ordner die Dateien eines einzigen.</translation>
    </message>
    <message>
        <source>%#1 of %#2 slices share their place with another (the first at %#3 mm along the normal); stacked, the volume would be %#4 mm too long.</source>
        <translation>%#1 von %#2 Schichten haben den Ort einer anderen (die erste bei %#3 mm entlang der Normalen); gestapelt wäre das Volumen %#4 mm zu lang.</translation>
    </message>
    <message>
        <source>%#1 slice is missing along the normal %2, where slices stand %#3 mm apart; closed up, what lies beyond would be %#4 mm off.</source>
        <translation>%#1 Schicht fehlt entlang der Normalen %2, wo Schichten %#3 mm auseinander stehen; zusammengeschoben läge, was dahinter kommt, %#4 mm falsch.</translation>
    </message>
    <message>
        <source>%#1 slices are missing along the normal %2, where slices stand %#3 mm apart; closed up, what lies beyond would be %#4 mm off.</source>
        <translation>%#1 Schichten fehlen entlang der Normalen %2, wo Schichten %#3 mm auseinander stehen; zusammengeschoben läge, was dahinter kommt, %#4 mm falsch.</translation>
    </message>
    <message>
        <source>Nothing was measured for %#1 mm between %#2 and %#3 mm, more than one missing slice leaves where slices stand %#4 mm apart; that is not interpolated.</source>
        <translation>Auf %#1 mm zwischen %#2 und %#3 mm wurde nichts gemessen, mehr, als eine fehlende Schicht lässt, wo Schichten %#4 mm auseinander stehen; das wird nicht interpoliert.</translation>
    </message>
    <message>
        <source>In %#1 places, %#2 mm of %#3 mm, a slice would have to be guessed; at most %#4 slice is interpolated. Whether slices were lost there or taken farther apart cannot be told, as no numbers run along the stack.</source>
        <translation>An %#1 Stellen, %#2 mm von %#3 mm, müsste eine Schicht geraten werden; höchstens %#4 Schicht wird interpoliert. Ob dort Schichten verloren gingen oder weiter auseinander aufgenommen wurden, lässt sich nicht sagen, da keine Nummern den Stapel entlang laufen.</translation>
    </message>
    <message>
        <source>In %#1 places, %#2 mm of %#3 mm, a slice would have to be guessed; at most %#4 slice is interpolated.</source>
        <translation>An %#1 Stellen, %#2 mm von %#3 mm, müsste eine Schicht geraten werden; höchstens %#4 Schicht wird interpoliert.</translation>
    </message>
    <message>
        <source>In %#1 places, %#2 mm of %#3 mm, a slice would have to be guessed; at most %#4 slices are interpolated. Whether slices were lost there or taken farther apart cannot be told, as no numbers run along the stack.</source>
        <translation>An %#1 Stellen, %#2 mm von %#3 mm, müsste eine Schicht geraten werden; höchstens %#4 Schichten werden interpoliert. Ob dort Schichten verloren gingen oder weiter auseinander aufgenommen wurden, lässt sich nicht sagen, da keine Nummern den Stapel entlang laufen.</translation>
    </message>
    <message>
        <source>In %#1 places, %#2 mm of %#3 mm, a slice would have to be guessed; at most %#4 slices are interpolated.</source>
        <translation>An %#1 Stellen, %#2 mm von %#3 mm, müsste eine Schicht geraten werden; höchstens %#4 Schichten werden interpoliert.</translation>
    </message>
    <message>
        <source>The slices do not stand evenly: near %#1 mm along the normal one lies %#2 mm from where an even spacing of %#3 mm would put it.%4</source>
        <translation>Die Schichten stehen nicht gleichmäßig: Nahe %#1 mm entlang der Normalen liegt eine %#2 mm neben dem Ort, an den ein gleichmäßiger Abstand von %#3 mm sie legte.%4</translation>
    </message>
    <message>
        <source>Slices lie up to %#1 mm off an even spacing; accepted.</source>
        <translation>Schichten liegen bis zu %#1 mm neben gleichmäßigem Abstand; angenommen.</translation>
    </message>
    <message>
        <source>The gantry was tilted: the stack leans by %#1 degrees and slides %#2 mm sideways; read as a straight stack, its ends would lie %#3 mm off.</source>
        <translation>Die Gantry war geneigt: Der Stapel lehnt um %#1 Grad und gleitet %#2 mm seitwärts; als gerader Stapel gelesen, lägen seine Enden %#3 mm falsch.</translation>
    </message>
    <message>
        <source>Slices lie up to %#1 mm sideways of one straight line through the stack.</source>
        <translation>Schichten liegen bis zu %#1 mm seitlich einer geraden Linie durch den Stapel.</translation>
    </message>
    <message>
        <source>Slices lie up to %#1 mm sideways of a straight stack; accepted.</source>
        <translation>Schichten liegen bis zu %#1 mm seitlich eines geraden Stapels; angenommen.</translation>
    </message>
    <message>
        <source>The header states slices %#1 mm apart, their positions %#2 mm; the positions are used.</source>
        <translation>Der Header nennt einen Schichtabstand von %#1 mm, die Lagen ergeben %#2 mm; die Lagen gelten.</translation>
    </message>
    <message>
        <source>The header states a gantry tilt of %#1 degrees, but the slices make a straight stack.</source>
        <translation>Der Header nennt eine Gantry-Neigung von %#1 Grad, die Schichten ergeben aber einen geraden Stapel.</translation>
    </message>
    <message>
        <source>is named as %~1, but is not; it is %2, so end its name in %3</source>
        <translation>ist als %~1 benannt, ist es aber nicht; sie ist %2, lassen Sie den Namen auf %3 enden</translation>
    </message>
    <message>
        <source>is named as %~1, but is not; give it the name of the format it is in</source>
        <translation>ist als %~1 benannt, ist es aber nicht; geben Sie ihr den Namen ihres Formats</translation>
    </message>
    <message>
        <source>cannot be written under this name; end it in %~1</source>
        <translation>lässt sich unter diesem Namen nicht schreiben; lassen Sie ihn auf %~1 enden</translation>
    </message>
    <message>
        <source>is empty; copy it again from where it came</source>
        <translation>ist leer; kopieren Sie sie noch einmal vom Ursprung</translation>
    </message>
    <message>
        <source>is not an ordinary file; name one that may be read</source>
        <translation>ist keine gewöhnliche Datei; nennen Sie eine, die gelesen werden darf</translation>
    </message>
    <message>
        <source>is %#1 GB large; a file of this kind is read up to 4.3 GB</source>
        <translation>ist %#1 GB groß; eine Datei dieser Art wird bis 4.3 GB gelesen</translation>
    </message>
    <message>
        <source>reading file</source>
        <translation>Datei wird gelesen</translation>
    </message>
    <message>
        <source>is a header whose file of voxels is not there; keep both in one folder</source>
        <translation>ist ein Header, dessen Datei mit den Voxeln nicht da ist; lassen Sie beide in einem Ordner</translation>
    </message>
    <message>
        <source>names a file of voxels that lies outside the folder of the header; check that it is the one that belongs to it</source>
        <translation>nennt eine Datei der Voxel, die außerhalb des Ordners des Kopfes liegt; prüfen Sie, ob es die zugehörige ist</translation>
    </message>
    <message>
        <source>its header gives impossible dimensions, %~1; export it again from where it came</source>
        <translation>ihr Header nennt unmögliche Abmessungen, %~1; exportieren Sie sie noch einmal vom Ursprung</translation>
    </message>
    <message>
        <source>its header gives no voxel size or place in the patient that can be true; export it again with its geometry</source>
        <translation>ihr Header nennt keine mögliche Voxelgröße oder Lage im Patienten; exportieren Sie sie mit ihrer Geometrie neu</translation>
    </message>
    <message>
        <source>its header puts it %#1 mm from the origin of the patient's frame; a place within 100 m is believed, export it again with its geometry</source>
        <translation>ihr Header legt sie %#1 mm vom Ursprung des Patientensystems; geglaubt wird eine Lage innerhalb von 100 m, exportieren Sie sie mit ihrer Geometrie neu</translation>
    </message>
    <message>
        <source>its axes are not perpendicular (off by %#1 degrees): taken as perpendicular, voxels would lie wrong by up to %#2 mm; resample it to perpendicular axes</source>
        <translation>ihre Achsen stehen nicht senkrecht (um %#1 Grad): als senkrecht genommen, lägen Voxel bis zu %#2 mm falsch; rechnen Sie sie auf senkrechte Achsen um</translation>
    </message>
    <message>
        <source>axes off perpendicular were straightened, which moves no voxel by more than %#1 mm</source>
        <translation>nicht senkrechte Achsen wurden aufgerichtet, was kein Voxel um mehr als %#1 mm verschiebt</translation>
    </message>
    <message>
        <source>holds %#1 voxels that are not finite numbers (NaN, infinite or beyond float); give them the value of what lies outside the scanned field, such as -1024 in a CT</source>
        <translation>enthält %#1 Voxel, die keine endlichen Zahlen sind (NaN, unendlich oder zu groß); geben Sie ihnen den Wert dessen, was außerhalb des Messfeldes liegt, etwa -1024 im CT</translation>
    </message>
    <message>
        <source>lies outside the region of interest, or that is thinner than a voxel; the image spans (x, y, z in LPS mm) %~1</source>
        <translation>liegt außerhalb des gewählten Bereichs, oder dieser ist dünner als ein Voxel; das Bild reicht (x, y, z in LPS mm) %~1</translation>
    </message>
    <message>
        <source>holds %#1 numbers a voxel (vectors or colours); an image of one number a voxel is needed</source>
        <translation>enthält %#1 Zahlen je Voxel (Vektoren oder Farben); nötig ist ein Bild mit einer Zahl je Voxel</translation>
    </message>
    <message>
        <source>is a single slice; a volume of at least 2 voxels along each axis is needed</source>
        <translation>ist eine einzelne Schicht; nötig ist ein Volumen mit mindestens 2 Voxeln entlang jeder Achse</translation>
    </message>
    <message>
        <source>reading image</source>
        <translation>Bild wird gelesen</translation>
    </message>
    <message>
        <source>give a smaller file</source>
        <translation>nehmen Sie eine kleinere Datei</translation>
    </message>
    <message>
        <source>is a file of voxels, whose volumes are told by number; it holds one, so name none</source>
        <translation>ist eine Datei mit Voxeln, deren Volumen nach Nummern gehen; sie enthält eines, nennen Sie daher keines</translation>
    </message>
    <message>
        <source>is a file of voxels, whose volumes are told by number; name one of 1 to %#1</source>
        <translation>ist eine Datei mit Voxeln, deren Volumen nach Nummern gehen; nennen Sie eines von 1 bis %#1</translation>
    </message>
    <message>
        <source>it holds one, so name none</source>
        <translation>sie enthält eines, nennen Sie daher keines</translation>
    </message>
    <message>
        <source>holds a value that is not a whole number</source>
        <translation>enthält einen Wert, der keine ganze Zahl ist</translation>
    </message>
    <message>
        <source>holds the value %#1</source>
        <translation>enthält den Wert %#1</translation>
    </message>
    <message>
        <source>%~1; labels are whole numbers from 0 to 65535 (an intensity image is given as CT or MR)</source>
        <translation>%~1; Labels sind ganze Zahlen von 0 bis 65535 (ein Bild mit Intensitäten geben Sie als CT oder MR)</translation>
    </message>
    <message>
        <source>export fewer of its structures at a time</source>
        <translation>exportieren Sie weniger ihrer Strukturen auf einmal</translation>
    </message>
    <message>
        <source>of the table of names beside it, %~1; that entry was left out</source>
        <translation>in der Namenstabelle daneben, %~1; dieser Eintrag blieb weg</translation>
    </message>
    <message>
        <source>%~1 has no name in the table of names</source>
        <translation>%~1 hat keinen Namen in der Namenstabelle</translation>
    </message>
    <message>
        <source>%~1 have no name in the table of names</source>
        <translation>%~1 haben keinen Namen in der Namenstabelle</translation>
    </message>
    <message>
        <source>holds no structure, every voxel is 0; voxels of a structure need a value from 1 on</source>
        <translation>enthält keine Struktur, jedes Voxel ist 0; Voxel einer Struktur brauchen einen Wert ab 1</translation>
    </message>
    <message>
        <source>its one value has no name in the table of names, so it is named by its file</source>
        <translation>ihr einziger Wert hat keinen Namen in der Namenstabelle und heißt daher nach der Datei</translation>
    </message>
    <message>
        <source>holds structures that overlap, in %#1 layers; one layer is needed here</source>
        <translation>enthält überlappende Strukturen, in %#1 Ebenen; hier ist eine Ebene nötig</translation>
    </message>
    <message>
        <source>names its structures itself, so the table of names was not used for it</source>
        <translation>benennt ihre Strukturen selbst, die Namenstabelle wurde daher nicht verwendet</translation>
    </message>
    <message>
        <source>holds %#1 numbers a voxel; a label file holds one whole number a voxel</source>
        <translation>enthält %#1 Zahlen je Voxel; eine Label-Datei enthält eine ganze Zahl je Voxel</translation>
    </message>
    <message>
        <source>'%1' was left out: the file puts it in a layer that it has not; save it again in 3D Slicer</source>
        <translation>„%1“ blieb weg: Die Datei legt es in eine Ebene, die sie nicht hat; speichern Sie sie in 3D Slicer neu</translation>
    </message>
    <message>
        <source>holds one layer, and structures overlap; write .seg.nrrd</source>
        <translation>enthält eine Ebene, und Strukturen überlappen sich; schreiben Sie .seg.nrrd</translation>
    </message>
    <message>
        <source>writing labels</source>
        <translation>Labels werden geschrieben</translation>
    </message>
    <message>
        <source>several structures are called '%~1'; one of them was named '%2'</source>
        <translation>mehrere Strukturen heißen „%~1“; eine davon wurde „%2“ genannt</translation>
    </message>
    <message>
        <source>structure %#1</source>
        <translation>Struktur %#1</translation>
    </message>
    <message>
        <source>its structure number %#1 has no label value from 1 to 65535; save it again in 3D Slicer</source>
        <translation>ihre Struktur Nummer %#1 hat keinen Labelwert von 1 bis 65535; speichern Sie sie in 3D Slicer neu</translation>
    </message>
    <message>
        <source>gives two structures the label value %#1; each needs its own, save it again in 3D Slicer</source>
        <translation>gibt zwei Strukturen den Labelwert %#1; jede braucht einen eigenen, speichern Sie sie in 3D Slicer neu</translation>
    </message>
    <message>
        <source>line %#1 %~2</source>
        <translation>Zeile %#1 %~2</translation>
    </message>
    <message>
        <source>gives the index %#1; an index is a whole number from 0 to 65535</source>
        <translation>gibt den Index %#1; ein Index ist eine ganze Zahl von 0 bis 65535</translation>
    </message>
    <message>
        <source>gives index %#1 no name</source>
        <translation>gibt dem Index %#1 keinen Namen</translation>
    </message>
    <message>
        <source>gives index %#1 a second name; each index has one</source>
        <translation>gibt dem Index %#1 einen zweiten Namen; jeder Index hat einen</translation>
    </message>
    <message>
        <source>gives index %#1 a second name (the first is in line %#2); each index has one</source>
        <translation>gibt dem Index %#1 einen zweiten Namen (der erste steht in Zeile %#2); jeder Index hat einen</translation>
    </message>
    <message>
        <source>opens a quote that is not closed</source>
        <translation>öffnet ein Anführungszeichen, das nicht geschlossen wird</translation>
    </message>
    <message>
        <source>gives an index that is not a whole number from 0 to 65535</source>
        <translation>gibt einen Index, der keine ganze Zahl von 0 bis 65535 ist</translation>
    </message>
    <message>
        <source>gives the index %#1 in column '%2' and %#3 in column '%4'; keep the one that the voxels have</source>
        <translation>gibt den Index %#1 in Spalte „%2“ an und %#3 in Spalte „%4“; behalten Sie den, den die Voxel haben</translation>
    </message>
    <message>
        <source>gives a colour that is neither three numbers from 0 to 255 (or 0 to 1) nor #rrggbb</source>
        <translation>gibt eine Farbe, die weder drei Zahlen von 0 bis 255 (oder 0 bis 1) noch #rrggbb ist</translation>
    </message>
    <message>
        <source>does not start with an index; an entry is index, name, r, g, b</source>
        <translation>beginnt nicht mit einem Index; ein Eintrag ist Index, Name, r, g, b</translation>
    </message>
    <message>
        <source>is no entry; it needs index, name and the colour r, g, b</source>
        <translation>ist kein Eintrag; nötig sind Index, Name und die Farbe r, g, b</translation>
    </message>
    <message>
        <source>the table of names has no column of opacity, so a number before the colour was read as part of the name ('%1')</source>
        <translation>die Namenstabelle hat keine Spalte für Deckkraft, eine Zahl vor der Farbe wurde daher als Teil des Namens gelesen („%1“)</translation>
    </message>
    <message>
        <source>{"1": "name"} or {"name": 1} would be right</source>
        <translation>richtig wäre {"1": "name"} oder {"name": 1}</translation>
    </message>
    <message>
        <source>is not valid JSON%1</source>
        <translation>ist kein gültiges JSON%1</translation>
    </message>
    <message>
        <source>has a number that is beyond all that is read%1</source>
        <translation>hat eine Zahl jenseits von allem, was gelesen wird%1</translation>
    </message>
    <message>
        <source>is no entry of a table of names%1</source>
        <translation>ist kein Eintrag einer Namenstabelle%1</translation>
    </message>
    <message>
        <source>gives '%1' a second time; each name has one index, and each index one name</source>
        <translation>gibt „%1“ ein zweites Mal; jeder Name hat einen Index und jeder Index einen Namen</translation>
    </message>
    <message>
        <source>is text in UTF-16; save it as UTF-8</source>
        <translation>ist Text in UTF-16; speichern Sie sie als UTF-8</translation>
    </message>
    <message>
        <source>the table of names is not in UTF-8 and was read as Latin-1</source>
        <translation>die Namenstabelle ist nicht in UTF-8 und wurde als Latin-1 gelesen</translation>
    </message>
    <message>
        <source>is too large for a table of names; give a colour table, a label description or a CSV</source>
        <translation>ist zu groß für eine Namenstabelle; nehmen Sie eine Farbtabelle, eine Labelbeschreibung oder eine CSV</translation>
    </message>
    <message>
        <source>holds no names of label values; a 3D Slicer colour table, an ITK-SNAP label description or a CSV with the columns index and name would be right</source>
        <translation>enthält keine Namen von Labelwerten; richtig wäre eine Farbtabelle von 3D Slicer, eine Labelbeschreibung von ITK-SNAP oder eine CSV mit den Spalten index und name</translation>
    </message>
    <message>
        <source>holds no names of label values: %~1; a 3D Slicer colour table, an ITK-SNAP label description or a CSV with the columns index and name would be right</source>
        <translation>enthält keine Namen von Labelwerten: %~1; richtig wäre eine Farbtabelle von 3D Slicer, eine Labelbeschreibung von ITK-SNAP oder eine CSV mit den Spalten index und name</translation>
    </message>
    <message>
        <source>its %~1</source>
        <translation>ihre %~1</translation>
    </message>
    <message>
        <source>needs %#1 GB of memory, which is not free; close programs or %~2</source>
        <translation>braucht %#1 GB Speicher, die nicht frei sind; schließen Sie Programme, oder %~2</translation>
    </message>
    <message>
        <source>its MetaImage header has %1 twice, with another value each; export it again</source>
        <translation>ihr MetaImage-Kopf hat %1 zweimal, mit je anderem Wert; exportieren Sie sie neu</translation>
    </message>
    <message>
        <source>its MetaImage header has %1 and %2, which are one field, with another value each; export it again</source>
        <translation>ihr MetaImage-Kopf hat %1 und %2, die ein Feld sind, mit je anderem Wert; exportieren Sie sie neu</translation>
    </message>
    <message>
        <source>its header gives no valid dimensions (NDims, DimSize); export it again</source>
        <translation>ihr Header nennt keine gültigen Abmessungen (NDims, DimSize); exportieren Sie sie neu</translation>
    </message>
    <message>
        <source>holds a picture of %#1 dimensions; a volume of 3 is needed</source>
        <translation>enthält ein Bild mit %#1 Dimensionen; nötig ist ein Volumen mit 3</translation>
    </message>
    <message>
        <source>names its axes otherwise (AnatomicalOrientation) than %1, as its TransformMatrix says, which is used; check left and right</source>
        <translation>benennt die Achsen anders (AnatomicalOrientation) als %1, wie die TransformMatrix sagt, die gilt; prüfen Sie links und rechts</translation>
    </message>
    <message>
        <source>names its axes otherwise (AnatomicalOrientation) than %1, as its missing TransformMatrix says, which is used; check left and right</source>
        <translation>benennt die Achsen anders (AnatomicalOrientation) als %1, wie die fehlende TransformMatrix sagt, die gilt; prüfen Sie links und rechts</translation>
    </message>
    <message>
        <source>its rescale slope or offset (ElementToIntensityFunction) is not a number that can be true; export it again from where it came</source>
        <translation>ihre Rescale Slope oder ihr Offset (ElementToIntensityFunction) ist keine mögliche Zahl; exportieren Sie sie noch einmal vom Ursprung</translation>
    </message>
    <message>
        <source>its header gives no valid voxel size, place or axes in three dimensions (ElementSpacing, Offset, TransformMatrix); export it again with its geometry</source>
        <translation>ihr Header nennt keine gültige Voxelgröße, Lage oder Achsen in drei Dimensionen (ElementSpacing, Offset, TransformMatrix); exportieren Sie sie mit ihrer Geometrie neu</translation>
    </message>
    <message>
        <source>states no full place in the patient (Offset, TransformMatrix): what is missing is taken as 0, 0, 0 and the patient's axes</source>
        <translation>nennt keine vollständige Lage im Patienten (Offset, TransformMatrix): Was fehlt, wird als 0, 0, 0 und die Achsen des Patienten genommen</translation>
    </message>
    <message>
        <source>states a negative voxel size (ElementSpacing), by which an axis runs the other way and the image is mirrored; check left and right</source>
        <translation>nennt eine negative Voxelgröße (ElementSpacing), durch die eine Achse umgekehrt läuft und das Bild gespiegelt ist; prüfen Sie links und rechts</translation>
    </message>
    <message>
        <source>its voxels are of a type that is not read; save them as one whole number or float each</source>
        <translation>ihre Voxel sind von einem nicht lesbaren Typ; speichern Sie sie als je eine ganze oder Gleitkommazahl</translation>
    </message>
    <message>
        <source>keeps its voxels as text, in several files or behind a foreign header; save it as one binary .mha</source>
        <translation>hält ihre Voxel als Text, in mehreren Dateien oder hinter einem fremden Header; speichern Sie sie als eine binäre .mha</translation>
    </message>
    <message>
        <source>is compressed; name it .nii.gz</source>
        <translation>ist komprimiert; nennen Sie sie .nii.gz</translation>
    </message>
    <message>
        <source>is damaged: its data are not those of their checksum; copy it again from where it came</source>
        <translation>ist beschädigt: Die Daten passen nicht zur Prüfsumme; kopieren Sie sie noch einmal vom Ursprung</translation>
    </message>
    <message>
        <source>breaks off in its NIfTI header; copy it again from where it came</source>
        <translation>bricht im NIfTI-Header ab; kopieren Sie sie noch einmal vom Ursprung</translation>
    </message>
    <message>
        <source>is an ANALYZE header, which does not say which side of the patient is left; convert it to NIfTI where that is known</source>
        <translation>ist ein ANALYZE-Header, der nicht sagt, welche Seite des Patienten links ist; wandeln Sie sie dort in NIfTI um, wo das bekannt ist</translation>
    </message>
    <message>
        <source>is the header of a pair of files; name them .hdr and .img</source>
        <translation>ist der Header eines Dateipaars; nennen Sie die beiden .hdr und .img</translation>
    </message>
    <message>
        <source>holds header and voxels in one; name it .nii</source>
        <translation>enthält Header und Voxel in einem; nennen Sie sie .nii</translation>
    </message>
    <message>
        <source>states no place in the patient: its axes are taken as the patient's, from 0, 0, 0</source>
        <translation>nennt keine Lage im Patienten: Ihre Achsen werden als die des Patienten genommen, ab 0, 0, 0</translation>
    </message>
    <message>
        <source>its header turns it by a quaternion (qform) that is not a rotation; export it again with its geometry</source>
        <translation>ihr Header dreht sie um ein Quaternion (qform), das keine Drehung ist; exportieren Sie sie mit ihrer Geometrie neu</translation>
    </message>
    <message>
        <source>states a negative voxel size (pixdim), which was taken without its sign</source>
        <translation>nennt eine negative Voxelgröße (pixdim), die ohne Vorzeichen genommen wurde</translation>
    </message>
    <message>
        <source>places itself twice, once by a quaternion (qform) that is not a rotation; the sform is used</source>
        <translation>nennt ihre Lage zweimal, einmal mit einem Quaternion (qform), das keine Drehung ist; die sform gilt</translation>
    </message>
    <message>
        <source>places itself twice (sform and qform), and the two are mirror images of each other: left and right cannot be told; export it again with one of them</source>
        <translation>gibt ihren Ort zweimal an (sform und qform), und beide sind Spiegelbilder voneinander: Links und rechts lassen sich nicht unterscheiden; exportieren Sie sie neu mit einem davon</translation>
    </message>
    <message>
        <source>is one of a pair of files; its %1 is not there, keep both in one folder</source>
        <translation>ist eine von einem Dateipaar; %1 ist nicht da, lassen Sie beide in einem Ordner</translation>
    </message>
    <message>
        <source>its header counts %#1 dimensions; a NIfTI file has 1 to 7</source>
        <translation>ihr Header zählt %#1 Dimensionen; eine NIfTI-Datei hat 1 bis 7</translation>
    </message>
    <message>
        <source>its header gives a dimension of %#1; export it again from where it came</source>
        <translation>ihr Header nennt eine Abmessung von %#1; exportieren Sie sie noch einmal vom Ursprung</translation>
    </message>
    <message>
        <source>its voxels should start beyond any sense; export it again from where it came</source>
        <translation>ihre Voxel beginnen laut Header an einem unmöglichen Ort; exportieren Sie sie noch einmal vom Ursprung</translation>
    </message>
    <message>
        <source>its rescale slope or intercept is not a number; export it again from where it came</source>
        <translation>ihre Rescale Slope oder ihr Intercept ist keine Zahl; exportieren Sie sie noch einmal vom Ursprung</translation>
    </message>
    <message>
        <source>writing voxels</source>
        <translation>Voxel werden geschrieben</translation>
    </message>
    <message>
        <source>its header has no valid '%~1'; it is damaged, restore it</source>
        <translation>ihr Header hat kein gültiges „%~1“; sie ist beschädigt, stellen Sie sie wieder her</translation>
    </message>
    <message>
        <source>its header gives impossible dimensions; it is damaged, restore it</source>
        <translation>ihr Header nennt unmögliche Abmessungen; sie ist beschädigt, stellen Sie sie wieder her</translation>
    </message>
    <message>
        <source>its header contradicts itself about the axes; it is damaged, restore it</source>
        <translation>ihr Header widerspricht sich bei den Achsen; sie ist beschädigt, stellen Sie sie wieder her</translation>
    </message>
    <message>
        <source>its header gives no valid grid; it is damaged, restore it</source>
        <translation>ihr Header nennt kein gültiges Gitter; sie ist beschädigt, stellen Sie sie wieder her</translation>
    </message>
    <message>
        <source>cannot be mapped into memory; close other cases or programs</source>
        <translation>lässt sich nicht in den Speicher einblenden; schließen Sie andere Fälle oder Programme</translation>
    </message>
    <message>
        <source>could not be read: the disk or medium was removed or reports an error</source>
        <translation>ließ sich nicht lesen: Der Datenträger wurde entfernt oder meldet einen Fehler</translation>
    </message>
    <message>
        <source>its header field '%1' is not '%2'; only files that this program wrote can be mapped, import it instead</source>
        <translation>ihr Headerfeld „%1“ ist nicht „%2“; einblenden lassen sich nur Dateien dieses Programms, importieren Sie sie stattdessen</translation>
    </message>
    <message>
        <source>its header has a field '%1'; only files that this program wrote can be mapped, import it instead</source>
        <translation>ihr Header hat ein Feld „%1“; einblenden lassen sich nur Dateien dieses Programms, importieren Sie sie stattdessen</translation>
    </message>
    <message>
        <source>its voxels do not start on a page; only files that this program wrote can be mapped, import it instead</source>
        <translation>ihre Voxel beginnen nicht auf einer Speicherseite; einblenden lassen sich nur Dateien dieses Programms, importieren Sie sie stattdessen</translation>
    </message>
    <message>
        <source>its voxels are of a type that is not mapped; short, unsigned short or float is</source>
        <translation>ihre Voxel sind von einem Typ, der nicht eingeblendet wird; short, unsigned short oder float werden es</translation>
    </message>
    <message>
        <source>is %#1 bytes long; its header asks for %#2, so it was cut off or changed, restore it</source>
        <translation>ist %#1 Byte lang; ihr Header verlangt %#2, sie wurde also abgeschnitten oder geändert, stellen Sie sie wieder her</translation>
    </message>
    <message>
        <source>its NRRD header does not end; copy it again from where it came</source>
        <translation>ihr NRRD-Header endet nicht; kopieren Sie sie noch einmal vom Ursprung</translation>
    </message>
    <message>
        <source>its NRRD header has a line that is not a field; copy it again from where it came</source>
        <translation>ihr NRRD-Header hat eine Zeile, die kein Feld ist; kopieren Sie sie noch einmal vom Ursprung</translation>
    </message>
    <message>
        <source>its NRRD header has a field twice, with another value each; export it again</source>
        <translation>ihr NRRD-Header hat ein Feld zweimal, mit verschiedenen Werten; exportieren Sie sie neu</translation>
    </message>
    <message>
        <source>states no patient frame: its axes are taken as the patient's</source>
        <translation>nennt kein Bezugssystem des Patienten: Ihre Achsen werden als die des Patienten genommen</translation>
    </message>
    <message>
        <source>its frame is not a patient's, and its axes are taken as the patient's</source>
        <translation>ihr Bezugssystem ist nicht das eines Patienten, und ihre Achsen werden als die des Patienten genommen</translation>
    </message>
    <message>
        <source>its frame is left-handed and not a patient's, so left and right cannot be told apart; export it in left-posterior-superior</source>
        <translation>ihr Bezugssystem ist linkshändig und nicht das eines Patienten, links und rechts sind daher nicht zu unterscheiden; exportieren Sie sie in left-posterior-superior</translation>
    </message>
    <message>
        <source>its header names a frame ('space') that NRRD does not know; export it in left-posterior-superior</source>
        <translation>ihr Header nennt ein Bezugssystem („space“), das NRRD nicht kennt; exportieren Sie sie in left-posterior-superior</translation>
    </message>
    <message>
        <source>its header gives the axes different units of length ('space units'), which cannot be meant; export it again with its geometry</source>
        <translation>ihr Kopf gibt den Achsen verschiedene Längeneinheiten („space units“), was nicht gemeint sein kann; exportieren Sie sie neu mit ihrer Geometrie</translation>
    </message>
    <message>
        <source>its header gives no valid dimensions (dimension, sizes); export it again</source>
        <translation>ihr Header nennt keine gültigen Abmessungen (dimension, sizes); exportieren Sie sie neu</translation>
    </message>
    <message>
        <source>its header gives no valid '%~1' in three dimensions; export it again with its geometry</source>
        <translation>ihr Header nennt kein gültiges „%~1“ in drei Dimensionen; exportieren Sie sie mit ihrer Geometrie neu</translation>
    </message>
    <message>
        <source>its header gives no voxel size ('space directions'); export it again with its geometry</source>
        <translation>ihr Header nennt keine Voxelgröße („space directions“); exportieren Sie sie mit ihrer Geometrie neu</translation>
    </message>
    <message>
        <source>states no place of its first voxel ('space origin'); taken as 0, 0, 0</source>
        <translation>nennt keine Lage ihres ersten Voxels („space origin“); als 0, 0, 0 genommen</translation>
    </message>
    <message>
        <source>its voxels are packed in a way that is not read; save it with encoding raw or gzip</source>
        <translation>ihre Voxel sind auf eine nicht lesbare Weise gepackt; speichern Sie sie mit encoding raw oder gzip</translation>
    </message>
    <message>
        <source>its list of data files is damaged, or does not share the %#1 slices evenly; save it as one .nrrd</source>
        <translation>ihre Liste der Datendateien ist beschädigt oder teilt die %#1 Schichten nicht gleich auf; speichern Sie sie als eine .nrrd</translation>
    </message>
    <message>
        <source>keeps its voxels as text in several files; save it as one .nrrd</source>
        <translation>hält ihre Voxel als Text in mehreren Dateien; speichern Sie sie als eine .nrrd</translation>
    </message>
    <message>
        <source>its header has no valid '%1'; export it again</source>
        <translation>ihr Header hat kein gültiges „%1“; exportieren Sie sie neu</translation>
    </message>
    <message>
        <source>counts its packed voxels from the end of the file; save it as one .nrrd</source>
        <translation>zählt ihre gepackten Voxel vom Ende der Datei; speichern Sie sie als eine .nrrd</translation>
    </message>
    <message>
        <source>its voxels are of a type that is not read; save them as whole numbers or float</source>
        <translation>ihre Voxel sind von einem nicht lesbaren Typ; speichern Sie sie als ganze oder Gleitkommazahlen</translation>
    </message>
    <message>
        <source>holds more than 65536 numbers a voxel; one is needed</source>
        <translation>enthält mehr als 65536 Zahlen je Voxel; nötig ist eine</translation>
    </message>
    <message>
        <source>holds %~1 voxels; a volume of 3 dimensions is needed</source>
        <translation>enthält %~1 Voxel; nötig ist ein Volumen mit 3 Dimensionen</translation>
    </message>
    <message>
        <source>its header does not say in which order the bytes of a number stand ('endian'); export it again</source>
        <translation>ihr Header sagt nicht, in welcher Folge die Bytes einer Zahl stehen („endian“); exportieren Sie sie neu</translation>
    </message>
    <message>
        <source>states which values its numbers stood for before they were packed ('old min', 'old max'); the numbers are taken as they are</source>
        <translation>nennt, für welche Werte ihre Zahlen vor dem Packen standen („old min“, „old max“); die Zahlen werden genommen, wie sie sind</translation>
    </message>
    <message>
        <source>compressing voxels</source>
        <translation>Voxel werden komprimiert</translation>
    </message>
    <message>
        <source>NIfTI holds at most 32767 voxels along an axis, not %#1; write .nrrd</source>
        <translation>NIfTI fasst höchstens 32767 Voxel entlang einer Achse, nicht %#1; schreiben Sie .nrrd</translation>
    </message>
    <message>
        <source>reading voxels</source>
        <translation>Voxel werden gelesen</translation>
    </message>
    <message>
        <source>needs %#1 GB of memory, which the system refuses; close programs or %~2</source>
        <translation>braucht %#1 GB Speicher, die das System verweigert; schließen Sie Programme, oder %~2</translation>
    </message>
    <message>
        <source>is of no format that is read; give a %~1 file</source>
        <translation>ist in keinem lesbaren Format; nehmen Sie eine Datei %~1</translation>
    </message>
    <message>
        <source>its voxels are of a type that is not read (colours, complex or long double); save them as whole numbers or float</source>
        <translation>ihre Voxel sind von einem nicht lesbaren Typ (Farben, komplex oder long double); speichern Sie sie als ganze oder Gleitkommazahlen</translation>
    </message>
    <message>
        <source>as the patient lies there</source>
        <translation>denn dort liegt der Patient</translation>
    </message>
    <message>
        <source>as the NIfTI standard says</source>
        <translation>wie der NIfTI-Standard sagt</translation>
    </message>
    <message>
        <source>places itself twice, in the space of a template (sform) and in that of the scanner (qform), up to %#1 mm apart; the qform is used, %~2</source>
        <translation>gibt seine Lage zweimal an, im Raum einer Vorlage (sform) und in dem des Scanners (qform), bis zu %#1 mm auseinander; die qform gilt, %~2</translation>
    </message>
    <message>
        <source>places itself twice, in the space of a template (sform) and in that of the scanner (qform), up to %#1 mm apart; the sform is used, %~2</source>
        <translation>gibt seine Lage zweimal an, im Raum einer Vorlage (sform) und in dem des Scanners (qform), bis zu %#1 mm auseinander; die sform gilt, %~2</translation>
    </message>
    <message>
        <source>places itself twice (sform and qform), up to %#1 mm apart; the qform is used, %~2</source>
        <translation>nennt ihre Lage zweimal (sform und qform), bis zu %#1 mm auseinander; die qform gilt, %~2</translation>
    </message>
    <message>
        <source>places itself twice (sform and qform), up to %#1 mm apart; the sform is used, %~2</source>
        <translation>nennt ihre Lage zweimal (sform und qform), bis zu %#1 mm auseinander; die sform gilt, %~2</translation>
    </message>
    <message>
        <source>states a unit of length that is not known</source>
        <translation>nennt eine unbekannte Längeneinheit</translation>
    </message>
    <message>
        <source>states no unit of length</source>
        <translation>nennt keine Längeneinheit</translation>
    </message>
    <message>
        <source>states mm</source>
        <translation>nennt mm</translation>
    </message>
    <message>
        <source>states %1</source>
        <translation>nennt %1</translation>
    </message>
    <message>
        <source>%~1, which was taken, %~2: its voxels are %3</source>
        <translation>%~1, was gilt, %~2: Die Voxel sind %3</translation>
    </message>
    <message>
        <source>%~1, but its numbers were taken in units of %#2 mm, %~3: its voxels are %4</source>
        <translation>%~1, aber die Zahlen gelten in Einheiten von %#2 mm, %~3: Die Voxel sind %4</translation>
    </message>
    <message>
        <source>states a unit of length that is not known; taken as mm</source>
        <translation>nennt eine unbekannte Längeneinheit; als mm genommen</translation>
    </message>
    <message>
        <source>states no unit of length; taken as mm</source>
        <translation>nennt keine Längeneinheit; als mm genommen</translation>
    </message>
    <message>
        <source>is in %1; converted, its voxels are %2</source>
        <translation>ist in %1; umgerechnet sind die Voxel %2</translation>
    </message>
    <message>
        <source>as asked</source>
        <translation>wie gewünscht</translation>
    </message>
    <message>
        <source>as its grid is then that of an image of the case</source>
        <translation>da das Gitter dann das eines Bildes des Falls ist</translation>
    </message>
    <message>
        <source>has the grid of no image of the case by either place: its middle is %#1 mm from that of the first by the qform, and %#2 mm by the sform</source>
        <translation>hat nach keiner der beiden Lagen das Gitter eines Bildes des Falls: Seine Mitte ist nach der qform %#1 mm von der des ersten entfernt, nach der sform %#2 mm</translation>
    </message>
    <message>
        <source>does not say which side of the patient is left; its axes were taken as RAS%~1</source>
        <translation>sagt nicht, welche Seite des Patienten links ist; die Achsen wurden als RAS genommen%~1</translation>
    </message>
    <message>
        <source>does not say which side of the patient is left; its axes were taken as LPS%~1</source>
        <translation>sagt nicht, welche Seite des Patienten links ist; die Achsen wurden als LPS genommen%~1</translation>
    </message>
    <message>
        <source>holds %~1 voxels; volumes of 3 dimensions are needed, at most one after the other along a fourth</source>
        <translation>enthält %~1 Voxel; nötig sind Volumen mit 3 Dimensionen, höchstens eines nach dem anderen entlang einer vierten</translation>
    </message>
    <message>
        <source>has no volume %#1; it holds one</source>
        <translation>hat kein Volumen %#1; sie enthält eines</translation>
    </message>
    <message>
        <source>has no volume %#1; it holds volumes 1 to %#2</source>
        <translation>hat kein Volumen %#1; sie enthält die Volumen 1 bis %#2</translation>
    </message>
    <message>
        <source>holds %#1 volumes, of which this is number %#2</source>
        <translation>enthält %#1 Volumen, von denen dies Nummer %#2 ist</translation>
    </message>
    <message>
        <source>holds %#1 volumes of %~2 voxels; one is needed: name it by its number, 1 to %#3 (--volume N, of an MR FILE##N), or save it alone</source>
        <translation>enthält %#1 Volumen von %~2 Voxeln; nötig ist eines: Wählen Sie es nach der Nummer, 1 bis %#3, oder speichern Sie es allein</translation>
    </message>
    <message>
        <source>holds %#1 volumes of %~2 voxels; one is needed: save each alone, or all as one volume with a value for each structure</source>
        <translation>enthält %#1 Volumen von %~2 Voxeln; nötig ist eines: Speichern Sie jedes allein, oder alle als ein Volumen mit einem Wert je Struktur</translation>
    </message>
    <message>
        <source>its header speaks of %~1 voxels, which the file is too short to hold; copy it again from where it came</source>
        <translation>ihr Header spricht von %~1 Voxeln, für die die Datei zu kurz ist; kopieren Sie sie noch einmal vom Ursprung</translation>
    </message>
    <message>
        <source>its file of voxels holds %#1 byte more than its header speaks of, left out at the end; if they are another header at the beginning, all voxels are shifted: check the image</source>
        <translation>ihre Datei der Voxel enthält %#1 Byte mehr, als ihr Kopf nennt, am Ende weggelassen; sind sie ein weiterer Kopf am Anfang, sind alle Voxel verschoben: prüfen Sie das Bild</translation>
    </message>
    <message>
        <source>its file of voxels holds %#1 bytes more than its header speaks of, left out at the end; if they are another header at the beginning, all voxels are shifted: check the image</source>
        <translation>ihre Datei der Voxel enthält %#1 Byte mehr, als ihr Kopf nennt, am Ende weggelassen; sind sie ein weiterer Kopf am Anfang, sind alle Voxel verschoben: prüfen Sie das Bild</translation>
    </message>
    <message>
        <source>holds %#1 byte behind its voxels, of which its header does not speak; left out</source>
        <translation>enthält hinter ihren Voxeln %#1 Byte, von denen ihr Kopf nicht spricht; weggelassen</translation>
    </message>
    <message>
        <source>holds %#1 bytes behind its voxels, of which its header does not speak; left out</source>
        <translation>enthält hinter ihren Voxeln %#1 Byte, von denen ihr Kopf nicht spricht; weggelassen</translation>
    </message>
    <message>
        <source>breaks off or is damaged within its voxels; copy it again from where it came</source>
        <translation>bricht innerhalb der Voxel ab oder ist dort beschädigt; kopieren Sie sie noch einmal vom Ursprung</translation>
    </message>
    <message>
        <source>export only the part of it around its structures</source>
        <translation>exportieren Sie nur den Teil um ihre Strukturen</translation>
    </message>
    <message>
        <source>give a region of interest</source>
        <translation>wählen Sie einen Bereich</translation>
    </message>
    <message>
        <source>holds far more voxels than its header says; export it again from where it came</source>
        <translation>enthält weit mehr Voxel, als der Header sagt; exportieren Sie sie noch einmal vom Ursprung</translation>
    </message>
    <message>
        <source>could not be read on; check the disk or network</source>
        <translation>ließ sich nicht weiterlesen; prüfen Sie Datenträger oder Netz</translation>
    </message>
    <message>
        <source>a vertex has a coordinate that is not a number</source>
        <translation>eine Ecke hat eine Koordinate, die keine Zahl ist</translation>
    </message>
    <message>
        <source>it has more vertices than can be numbered</source>
        <translation>sie hat mehr Ecken, als nummerierbar sind</translation>
    </message>
    <message>
        <source>a face has fewer than three corners</source>
        <translation>eine Fläche hat weniger als drei Ecken</translation>
    </message>
    <message>
        <source>a face names a vertex that is not there</source>
        <translation>eine Fläche nennt eine Ecke, die nicht da ist</translation>
    </message>
    <message>
        <source>is damaged: %~1; export it again from where it came</source>
        <translation>ist beschädigt: %~1; exportieren Sie sie noch einmal vom Ursprung</translation>
    </message>
    <message>
        <source>holds no triangle; a surface of at least one is needed</source>
        <translation>enthält kein Dreieck; nötig ist eine Oberfläche mit mindestens einem</translation>
    </message>
    <message>
        <source>is of no surface format that is read; give a %~1 file</source>
        <translation>ist in keinem lesbaren Format für Oberflächen; nehmen Sie eine Datei %~1</translation>
    </message>
    <message>
        <source>states both SPACE=RAS and SPACE=LPS; remove the wrong statement</source>
        <translation>gibt SPACE=RAS und SPACE=LPS an; entfernen Sie die falsche Angabe</translation>
    </message>
    <message>
        <source>unit mm</source>
        <translation>Einheit mm</translation>
    </message>
    <message>
        <source>is in RAS coordinates (SPACE=RAS); x and y were negated to the patient's LPS</source>
        <translation>ist in RAS-Koordinaten (SPACE=RAS); x und y wurden in das LPS des Patienten umgekehrt</translation>
    </message>
    <message>
        <source>is in RAS coordinates (as given); x and y were negated to the patient's LPS</source>
        <translation>ist in RAS-Koordinaten (wie angegeben); x und y wurden in das LPS des Patienten umgekehrt</translation>
    </message>
    <message>
        <source>states SPACE=RAS, and was read otherwise, as given</source>
        <translation>nennt SPACE=RAS und wurde, wie angegeben, anders gelesen</translation>
    </message>
    <message>
        <source>states SPACE=LPS, and was read otherwise, as given</source>
        <translation>nennt SPACE=LPS und wurde, wie angegeben, anders gelesen</translation>
    </message>
    <message>
        <source>has a unit of %#1 mm, as given; brought to mm</source>
        <translation>hat, wie angegeben, die Einheit %#1 mm; in mm umgerechnet</translation>
    </message>
    <message>
        <source>mesh: it has no triangle to write</source>
        <translation>Netz: Es hat kein Dreieck zu schreiben</translation>
    </message>
    <message>
        <source>a face has a corner that is not a vertex index</source>
        <translation>eine Fläche hat eine Ecke, die kein Eckenindex ist</translation>
    </message>
    <message>
        <source>a vertex has fewer than three numbers</source>
        <translation>eine Ecke hat weniger als drei Zahlen</translation>
    </message>
    <message>
        <source>a line is not an OBJ record</source>
        <translation>eine Zeile ist kein OBJ-Datensatz</translation>
    </message>
    <message>
        <source>it does not start as PLY</source>
        <translation>sie beginnt nicht als PLY</translation>
    </message>
    <message>
        <source>its header names no format</source>
        <translation>ihr Header nennt kein Format</translation>
    </message>
    <message>
        <source>its header has an unknown line</source>
        <translation>ihr Header hat eine unbekannte Zeile</translation>
    </message>
    <message>
        <source>its header does not end</source>
        <translation>ihr Header endet nicht</translation>
    </message>
    <message>
        <source>its header names an unknown format</source>
        <translation>ihr Header nennt ein unbekanntes Format</translation>
    </message>
    <message>
        <source>its header has an element without a count</source>
        <translation>ihr Header hat ein Element ohne Anzahl</translation>
    </message>
    <message>
        <source>its header has a list of an unknown type</source>
        <translation>ihr Header hat eine Liste unbekannten Typs</translation>
    </message>
    <message>
        <source>its header has a property of an unknown type</source>
        <translation>ihr Header hat eine Eigenschaft unbekannten Typs</translation>
    </message>
    <message>
        <source>its header counts more than the file can hold</source>
        <translation>ihr Header zählt mehr, als die Datei fassen kann</translation>
    </message>
    <message>
        <source>it breaks off, or has a word where a number belongs</source>
        <translation>sie bricht ab oder hat ein Wort, wo eine Zahl hingehört</translation>
    </message>
    <message>
        <source>it breaks off</source>
        <translation>sie bricht ab</translation>
    </message>
    <message>
        <source>a list has no valid length</source>
        <translation>eine Liste hat keine gültige Länge</translation>
    </message>
    <message>
        <source>a list is longer than the file</source>
        <translation>eine Liste ist länger als die Datei</translation>
    </message>
    <message>
        <source>its vertices have no x, y and z</source>
        <translation>ihre Ecken haben kein x, y und z</translation>
    </message>
    <message>
        <source>its faces have no list vertex_indices</source>
        <translation>ihre Flächen haben keine Liste vertex_indices</translation>
    </message>
    <message>
        <source>a facet has not three corners</source>
        <translation>eine Facette hat nicht drei Ecken</translation>
    </message>
    <message>
        <source>a line does not belong to an ASCII STL</source>
        <translation>eine Zeile gehört nicht zu einer ASCII-STL</translation>
    </message>
    <message>
        <source>it breaks off before 'endsolid'</source>
        <translation>sie bricht vor „endsolid“ ab</translation>
    </message>
    <message>
        <source>is %#1 bytes long, but an STL of the %#2 triangles that it counts has %#3; copy it again from where it came</source>
        <translation>ist %#1 Byte lang, eine STL mit den %#2 Dreiecken, die sie zählt, aber %#3; kopieren Sie sie noch einmal vom Ursprung</translation>
    </message>
    <message>
        <source>it declares a document type</source>
        <translation>sie erklärt einen Dokumenttyp</translation>
    </message>
    <message>
        <source>it is no well-formed XML</source>
        <translation>sie ist kein wohlgeformtes XML</translation>
    </message>
    <message>
        <source>it is no surface of the VTK XML format</source>
        <translation>sie ist keine Oberfläche im VTK-XML-Format</translation>
    </message>
    <message>
        <source>its %1 is no number</source>
        <translation>ihr %1 ist keine Zahl</translation>
    </message>
    <message>
        <source>it is of version %1 of the VTK XML format; 0.1 to 2 are read</source>
        <translation>sie hat Version %1 des VTK-XML-Formats; gelesen werden 0.1 bis 2</translation>
    </message>
    <message>
        <source>its byte_order is neither LittleEndian nor BigEndian</source>
        <translation>ihre byte_order ist weder LittleEndian noch BigEndian</translation>
    </message>
    <message>
        <source>its header_type is neither UInt32 nor UInt64</source>
        <translation>ihr header_type ist weder UInt32 noch UInt64</translation>
    </message>
    <message>
        <source>its appended data do not begin with an underscore</source>
        <translation>ihre angehängten Daten beginnen nicht mit einem Unterstrich</translation>
    </message>
    <message>
        <source>the array %1 is there twice; one time step is read</source>
        <translation>das Feld %1 ist zweimal da; gelesen wird ein Zeitschritt</translation>
    </message>
    <message>
        <source>points or faces are stated without the array that holds them</source>
        <translation>Punkte oder Flächen sind genannt, ohne das Feld, das sie enthält</translation>
    </message>
    <message>
        <source>has %#1 components instead of %#2</source>
        <translation>hat %#1 Komponenten statt %#2</translation>
    </message>
    <message>
        <source>is stated with more numbers than it can hold</source>
        <translation>nennt mehr Zahlen, als es fassen kann</translation>
    </message>
    <message>
        <source>is not of integer numbers</source>
        <translation>besteht nicht aus ganzen Zahlen</translation>
    </message>
    <message>
        <source>is of a type that is no number</source>
        <translation>ist von einem Typ, der keine Zahl ist</translation>
    </message>
    <message>
        <source>its array %1 %~2</source>
        <translation>ihr Feld %1 %~2</translation>
    </message>
    <message>
        <source>holds a word that is no number</source>
        <translation>enthält ein Wort, das keine Zahl ist</translation>
    </message>
    <message>
        <source>holds more than the %#1 numbers stated</source>
        <translation>enthält mehr als die genannten %#1 Zahlen</translation>
    </message>
    <message>
        <source>holds %#1 of the %#2 numbers stated</source>
        <translation>enthält %#1 der genannten %#2 Zahlen</translation>
    </message>
    <message>
        <source>ends within its header</source>
        <translation>endet in seinem Header</translation>
    </message>
    <message>
        <source>is of no format of the VTK XML format (ascii, binary, appended)</source>
        <translation>ist in keinem Format des VTK-XML-Formats (ascii, binary, appended)</translation>
    </message>
    <message>
        <source>lies after the end of the appended data</source>
        <translation>liegt hinter dem Ende der angehängten Daten</translation>
    </message>
    <message>
        <source>states %#1 bytes, its points or faces take %#2</source>
        <translation>nennt %#1 Byte, seine Punkte oder Flächen brauchen %#2</translation>
    </message>
    <message>
        <source>states more bytes than the file holds</source>
        <translation>nennt mehr Byte, als die Datei enthält</translation>
    </message>
    <message>
        <source>ends too early</source>
        <translation>endet zu früh</translation>
    </message>
    <message>
        <source>is compressed in a way that is not read; zlib, LZ4 and LZMA are</source>
        <translation>ist auf eine nicht lesbare Weise komprimiert; zlib, LZ4 und LZMA sind lesbar</translation>
    </message>
    <message>
        <source>states more blocks than the file holds</source>
        <translation>nennt mehr Blöcke, als die Datei enthält</translation>
    </message>
    <message>
        <source>states blocks of another length than its points or faces take</source>
        <translation>nennt Blöcke anderer Länge, als seine Punkte oder Flächen brauchen</translation>
    </message>
    <message>
        <source>states a block longer than the file</source>
        <translation>nennt einen Block, länger als die Datei</translation>
    </message>
    <message>
        <source>states more bytes than its blocks can hold</source>
        <translation>nennt mehr Byte, als seine Blöcke fassen können</translation>
    </message>
    <message>
        <source>states a block longer than what it unpacks to</source>
        <translation>nennt einen Block, länger als sein entpackter Inhalt</translation>
    </message>
    <message>
        <source>has a block that does not unpack to the length stated</source>
        <translation>hat einen Block, der sich nicht auf die genannte Länge entpackt</translation>
    </message>
    <message>
        <source>its array %1 does not rise</source>
        <translation>ihr Feld %1 steigt nicht</translation>
    </message>
    <message>
        <source>its array %1 names a point that is not there</source>
        <translation>ihr Feld %1 nennt einen Punkt, der nicht da ist</translation>
    </message>
    <message>
        <source>a strip has fewer than three corners</source>
        <translation>ein Streifen hat weniger als drei Ecken</translation>
    </message>
    <message>
        <source>takes more memory than there is</source>
        <translation>braucht mehr Speicher, als da ist</translation>
    </message>
    <message>
        <source>holds several volumes, layers or numbers a voxel; give it by itself</source>
        <translation>enthält mehrere Volumen, Ebenen oder Zahlen je Voxel; geben Sie sie für sich</translation>
    </message>
    <message>
        <source>holds a voxel that is not a number (NaN); a mask holds 0 and one whole number</source>
        <translation>enthält ein Voxel, das keine Zahl ist (NaN); eine Maske enthält 0 und eine ganze Zahl</translation>
    </message>
    <message>
        <source>holds more than one value (an image, or several structures, which are given by themselves)</source>
        <translation>enthält mehr als einen Wert (ein Bild, oder mehrere Strukturen, die man für sich gibt)</translation>
    </message>
    <message>
        <source>holds a value that is not a whole number from 1 to 65535</source>
        <translation>enthält einen Wert, der keine ganze Zahl von 1 bis 65535 ist</translation>
    </message>
    <message>
        <source>is a folder that cannot be listed; allow it</source>
        <translation>ist ein Ordner, der sich nicht auflisten lässt; erlauben Sie es</translation>
    </message>
    <message>
        <source>%1 is a link to a file outside the folder, and was left out</source>
        <translation>%1 ist eine Verknüpfung mit einer Datei außerhalb des Ordners und blieb weg</translation>
    </message>
    <message>
        <source>%1 belongs to a link to a file outside the folder, and was left out</source>
        <translation>%1 gehört zu einer Verknüpfung mit einer Datei außerhalb des Ordners und blieb weg</translation>
    </message>
    <message>
        <source>%1 is not a file, and was left out</source>
        <translation>%1 ist keine Datei und blieb weg</translation>
    </message>
    <message>
        <source>%1 is no %~2 file, and was left out</source>
        <translation>%1 ist keine Datei %~2 und blieb weg</translation>
    </message>
    <message>
        <source>%~1; copy it again, or take it out of the folder</source>
        <translation>%~1; kopieren Sie sie noch einmal, oder nehmen Sie sie aus dem Ordner</translation>
    </message>
    <message>
        <source>%1 was left out: it %~2</source>
        <translation>%1 blieb weg: sie %~2</translation>
    </message>
    <message>
        <source>holds more than 65535 structures</source>
        <translation>enthält mehr als 65535 Strukturen</translation>
    </message>
    <message>
        <source>several of its files differ in their ending only; their structures were numbered</source>
        <translation>mehrere ihrer Dateien unterscheiden sich nur in der Endung; ihre Strukturen wurden nummeriert</translation>
    </message>
    <message>
        <source>holds structures that overlap, or lie on different grids, in more voxels than are read; give fewer of them at a time</source>
        <translation>enthält Strukturen, die sich überlappen oder auf verschiedenen Gittern liegen, in mehr Voxeln, als gelesen werden; geben Sie weniger auf einmal</translation>
    </message>
    <message>
        <source>give fewer of its files at a time</source>
        <translation>geben Sie weniger der Dateien auf einmal</translation>
    </message>
    <message>
        <source>is a folder without a mask, a %~1 file with one value beside 0%2</source>
        <translation>ist ein Ordner ohne Maske, eine Datei %~1 mit einem Wert neben 0%2</translation>
    </message>
    <message>
        <source>its structures lie on %#1 different grids, and each was kept on its own</source>
        <translation>die Strukturen liegen auf %#1 verschiedenen Gittern, und jede blieb auf ihrem eigenen</translation>
    </message>
    <message>
        <source>some of its structures overlap, so they were kept in %#1 layers</source>
        <translation>einige der Strukturen überlappen sich und blieben daher in %#1 Ebenen</translation>
    </message>
    <message>
        <source>is a DICOM segmentation of a type that is not read; export it as BINARY, FRACTIONAL or LABELMAP</source>
        <translation>ist eine DICOM-Segmentierung von einem nicht lesbaren Typ; exportieren Sie sie als BINARY, FRACTIONAL oder LABELMAP</translation>
    </message>
    <message>
        <source>its frame %#1 %~2; export the segmentation again</source>
        <translation>ihr Frame %#1 %~2; exportieren Sie die Segmentierung neu</translation>
    </message>
    <message>
        <source>states its place twice, for itself and for all frames, and they differ</source>
        <translation>gibt seinen Ort zweimal an, für sich und für alle Bilder, und sie sind verschieden</translation>
    </message>
    <message>
        <source>states no position</source>
        <translation>nennt keine Lage</translation>
    </message>
    <message>
        <source>states no orientation or no pixel spacing</source>
        <translation>nennt keine Orientierung oder Pixelgröße</translation>
    </message>
    <message>
        <source>has another orientation or pixel spacing than the first, which is not read</source>
        <translation>hat eine andere Orientierung oder Pixelgröße als der erste, was nicht gelesen wird</translation>
    </message>
    <message>
        <source>its frame %#1 names no segment; export the segmentation again</source>
        <translation>ihr Frame %#1 nennt kein Segment; exportieren Sie die Segmentierung neu</translation>
    </message>
    <message>
        <source>has a damaged compressed frame; copy or export it again</source>
        <translation>hat einen beschädigten komprimierten Frame; kopieren oder exportieren Sie sie neu</translation>
    </message>
    <message>
        <source>holds compressed frames of more than 64 million pixels; export it uncompressed</source>
        <translation>enthält komprimierte Frames mit mehr als 64 Millionen Pixeln; exportieren Sie sie unkomprimiert</translation>
    </message>
    <message>
        <source>is a DICOM segmentation of a compression that is not read or not lossless; export it uncompressed (explicit VR little endian)</source>
        <translation>ist eine DICOM-Segmentierung mit einer Kompression, die nicht gelesen wird oder nicht verlustfrei ist; exportieren Sie sie unkomprimiert (explicit VR little endian)</translation>
    </message>
    <message>
        <source>holds fewer pixels than its %#1 frames need; copy or export it again</source>
        <translation>enthält weniger Pixel, als ihre %#1 Frames brauchen; kopieren oder exportieren Sie sie neu</translation>
    </message>
    <message>
        <source>its rows, columns and bits of a pixel are not those of its type of segmentation; export it again</source>
        <translation>ihre Zeilen, Spalten und Bits je Pixel sind nicht die ihres Segmentierungstyps; exportieren Sie sie neu</translation>
    </message>
    <message>
        <source>holds no pixel data; copy or export it again</source>
        <translation>enthält keine Pixeldaten; kopieren oder exportieren Sie sie neu</translation>
    </message>
    <message>
        <source>states no spacing of its slices, which are %#1 mm thick; those of the image are %#2 mm apart, which was taken, so that what lies between the slices of the file is empty; check the volumes</source>
        <translation>nennt keinen Abstand ihrer Schichten, die %#1 mm dick sind; genommen wurde der des Bildes von %#2 mm, sodass zwischen den Schichten der Datei leer ist; prüfen Sie die Volumen</translation>
    </message>
    <message>
        <source>states no spacing of its one slice, which is %#1 mm thick; the slices of the image are %#2 mm apart, which was taken; check the volumes</source>
        <translation>nennt keinen Abstand ihrer einen Schicht, die %#1 mm dick ist; genommen wurde der Schichtabstand des Bildes von %#2 mm; prüfen Sie die Volumen</translation>
    </message>
    <message>
        <source>states no spacing of its one slice, which is %#1 mm thick; that was taken</source>
        <translation>nennt keinen Abstand ihrer einen Schicht, die %#1 mm dick ist; das wurde genommen</translation>
    </message>
    <message>
        <source>states no spacing of its slices; its frames lie %#1 mm apart or more</source>
        <translation>nennt keinen Schichtabstand; ihre Frames liegen %#1 mm oder mehr auseinander</translation>
    </message>
    <message>
        <source>%1 and are %#2 mm thick, so that what lies between them was taken to be empty</source>
        <translation>%1 und sind %#2 mm dick, sodass als leer gilt, was dazwischen liegt</translation>
    </message>
    <message>
        <source>%1, which was taken for their thickness; check the volumes</source>
        <translation>%1, was als ihre Dicke genommen wurde; prüfen Sie die Volumen</translation>
    </message>
    <message>
        <source>has no orientation that can be true</source>
        <translation>hat keine mögliche Orientierung</translation>
    </message>
    <message>
        <source>its one slice states no thickness and no spacing; export the segmentation again</source>
        <translation>ihre eine Schicht nennt weder Dicke noch Abstand; exportieren Sie die Segmentierung neu</translation>
    </message>
    <message>
        <source>its frames lie %#1 mm apart, in more voxels than are read; crop it, or look at the positions of its frames</source>
        <translation>ihre Frames liegen %#1 mm auseinander, in mehr Voxeln, als gelesen werden; beschneiden Sie sie, oder prüfen Sie die Lage ihrer Frames</translation>
    </message>
    <message>
        <source>lies %#1 mm off the even slices of the others (uneven spacing or a tilted gantry), which is not read</source>
        <translation>liegt %#1 mm neben den gleichmäßigen Schichten der anderen (ungleicher Abstand oder geneigte Gantry), was nicht gelesen wird</translation>
    </message>
    <message>
        <source>frames up to %#1 mm off even slices were taken to lie on them</source>
        <translation>Frames bis zu %#1 mm neben gleichmäßigen Schichten wurden genommen, als lägen sie darauf</translation>
    </message>
    <message>
        <source>cannot be read to its end; copy it again</source>
        <translation>lässt sich nicht bis zum Ende lesen; kopieren Sie sie noch einmal</translation>
    </message>
    <message>
        <source>export fewer of its segments at a time</source>
        <translation>exportieren Sie weniger ihrer Segmente auf einmal</translation>
    </message>
    <message>
        <source>its segments overlap in more layers than are read; export fewer of them at a time</source>
        <translation>ihre Segmente überlappen sich in mehr Ebenen, als gelesen werden; exportieren Sie weniger auf einmal</translation>
    </message>
    <message>
        <source>lies where frame %#1 of the same segment does, and differs from it</source>
        <translation>liegt, wo der Frame %#1 desselben Segments liegt, und weicht davon ab</translation>
    </message>
    <message>
        <source>has %#1 empty frame (the first is frame %#2) where another of the same segment lies, which was taken</source>
        <translation>hat %#1 leeren Frame (der erste ist Frame %#2), wo ein anderer desselben Segments liegt, der genommen wurde</translation>
    </message>
    <message>
        <source>has %#1 empty frames (the first is frame %#2) where another of the same segment lies, which was taken</source>
        <translation>hat %#1 leere Frames (der erste ist Frame %#2), wo ein anderer desselben Segments liegt, der genommen wurde</translation>
    </message>
    <message>
        <source>lies where frame %#1 does, and differs from it</source>
        <translation>liegt, wo der Frame %#1 liegt, und weicht davon ab</translation>
    </message>
    <message>
        <source>is of segment %#1, which the file does not describe</source>
        <translation>gehört zum Segment %#1, das die Datei nicht beschreibt</translation>
    </message>
    <message>
        <source>is cut short or damaged; copy or export it again</source>
        <translation>ist abgeschnitten oder beschädigt; kopieren oder exportieren Sie sie neu</translation>
    </message>
    <message>
        <source>describes its frames in more than 512 MB; export fewer of its segments at a time</source>
        <translation>beschreibt ihre Frames in mehr als 512 MB; exportieren Sie weniger ihrer Segmente auf einmal</translation>
    </message>
    <message>
        <source>describes another number of frames (%#1) than it states; export the segmentation again</source>
        <translation>beschreibt eine andere Zahl von Frames (%#1), als sie nennt; exportieren Sie die Segmentierung neu</translation>
    </message>
    <message>
        <source>holds fractions (occupancy): voxels of 50 % and more were taken as the structure</source>
        <translation>enthält Anteile (Belegung): Voxel ab 50 % wurden als die Struktur genommen</translation>
    </message>
    <message>
        <source>holds fractions (probability): voxels of 50 % and more were taken as the structure</source>
        <translation>enthält Anteile (Wahrscheinlichkeit): Voxel ab 50 % wurden als die Struktur genommen</translation>
    </message>
    <message>
        <source>describes a segment without a number, or two of one number; export it again</source>
        <translation>beschreibt ein Segment ohne Nummer oder zwei mit gleicher; exportieren Sie sie neu</translation>
    </message>
    <message>
        <source>reading contours</source>
        <translation>Konturen werden gelesen</translation>
    </message>
    <message>
        <source>export fewer structures at a time</source>
        <translation>exportieren Sie weniger Strukturen auf einmal</translation>
    </message>
    <message>
        <source>holds more than 1 GB of contours; export fewer structures at a time</source>
        <translation>enthält mehr als 1 GB Konturen; exportieren Sie weniger Strukturen auf einmal</translation>
    </message>
    <message>
        <source>has a contour whose points are not numbers, three a point; export it again</source>
        <translation>hat eine Kontur, deren Punkte nicht je drei Zahlen sind; exportieren Sie sie neu</translation>
    </message>
    <message>
        <source>has a contour of %#1 points that states another number of them (Number of Contour Points): points are missing or too many; export it again</source>
        <translation>hat eine Kontur aus %#1 Punkten, die eine andere Zahl nennt (Number of Contour Points): Punkte fehlen oder sind zu viel; exportieren Sie neu</translation>
    </message>
    <message>
        <source>has a contour with a point more than 10 m from the origin; contours are in mm within the patient: look for a coordinate without its decimal point, and export it again</source>
        <translation>hat eine Kontur mit einem Punkt mehr als 10 m vom Ursprung; Konturen sind in mm im Patienten: Suchen Sie eine Koordinate ohne Dezimalpunkt, und exportieren Sie sie neu</translation>
    </message>
    <message>
        <source>has a contour whose offset (Contour Offset Vector) is not three numbers; export it again</source>
        <translation>hat eine Kontur, deren Verschiebung (Contour Offset Vector) nicht aus drei Zahlen besteht; exportieren Sie neu</translation>
    </message>
    <message>
        <source>has a contour that is to be moved within its plane (Contour Offset Vector), where DICOM lets it be moved across only; export it again, without an offset</source>
        <translation>hat eine Kontur, die in ihrer Ebene verschoben werden soll (Contour Offset Vector), was DICOM nur quer dazu vorsieht; exportieren Sie neu, ohne Verschiebung</translation>
    </message>
    <message>
        <source>'%1': %#2 contour was moved by %#3 mm, as the file states (Contour Offset Vector); programs that ignore this show the structure elsewhere</source>
        <translation>'%1': %#2 Kontur wurde um %#3 mm verschoben, wie die Datei es angibt (Contour Offset Vector); Programme, die das übergehen, zeigen die Struktur anderswo</translation>
    </message>
    <message>
        <source>'%1': %#2 contours were moved by %#3 mm, as the file states (Contour Offset Vector); programs that ignore this show the structure elsewhere</source>
        <translation>'%1': %#2 Konturen wurden um %#3 mm verschoben, wie die Datei es angibt (Contour Offset Vector); Programme, die das übergehen, zeigen die Struktur anderswo</translation>
    </message>
    <message>
        <source>'%1': %#2 contour has an offset (Contour Offset Vector) without a slab to which it would apply; nothing was moved</source>
        <translation>'%1': %#2 Kontur hat eine Verschiebung (Contour Offset Vector) ohne eine Scheibe, für die sie gälte; nichts wurde verschoben</translation>
    </message>
    <message>
        <source>'%1': %#2 contours have an offset (Contour Offset Vector) without a slab to which it would apply; nothing was moved</source>
        <translation>'%1': %#2 Konturen haben eine Verschiebung (Contour Offset Vector) ohne eine Scheibe, für die sie gälte; nichts wurde verschoben</translation>
    </message>
    <message>
        <source>'%1': the file states that its one plane stands for %#2 mm, which cannot be so on slices of %#3 mm; it stands for one slice; check its volume</source>
        <translation>'%1': Nach der Datei steht die einzige Ebene für %#2 mm, was bei Schichten von %#3 mm nicht sein kann; sie steht für eine Schicht; prüfen Sie das Volumen</translation>
    </message>
    <message>
        <source>'%1': its one plane stands for %#2 mm, as the file states, and not for one slice of %#3 mm; check its volume</source>
        <translation>'%1': Die einzige Ebene steht für %#2 mm, wie die Datei sagt, und nicht für eine Schicht von %#3 mm; prüfen Sie das Volumen</translation>
    </message>
    <message>
        <source>'%1': the file states planes %#2 mm apart (Spacing Between Slices), but its contours lie otherwise; each stands for %#3 mm, as far as they lie apart; check its volume</source>
        <translation>'%1': Die Datei nennt Ebenen im Abstand von %#2 mm (Spacing Between Slices), doch die Konturen liegen anders; jede steht für %#3 mm, so weit sie auseinander liegen; prüfen Sie das Volumen</translation>
    </message>
    <message>
        <source>'%1': its contours lie %#2 mm apart, but the file states planes %#3 mm apart (Spacing Between Slices); at the ends and beside gaps each stands for %#4 mm; check its volume</source>
        <translation>'%1': Die Konturen liegen %#2 mm auseinander, doch die Datei nennt Ebenen im Abstand von %#3 mm (Spacing Between Slices); an den Enden und neben Lücken steht jede für %#4 mm; prüfen Sie das Volumen</translation>
    </message>
    <message>
        <source>'%1': its contours state slabs of several thicknesses (Contour Slab Thickness); each stands for %#2 mm; check its volume</source>
        <translation>'%1': Die Konturen nennen Scheiben verschiedener Dicke (Contour Slab Thickness); jede steht für %#2 mm; prüfen Sie das Volumen</translation>
    </message>
    <message>
        <source>'%1': its contours state slabs of several thicknesses (Contour Slab Thickness); each stands for %#2 mm, as far as they lie apart; check its volume</source>
        <translation>'%1': Die Konturen nennen Scheiben verschiedener Dicke (Contour Slab Thickness); jede steht für %#2 mm, so weit sie auseinander liegen; prüfen Sie das Volumen</translation>
    </message>
    <message>
        <source>'%1': its contours state slabs of %#2 mm (Contour Slab Thickness); each stands for %#3 mm; check its volume</source>
        <translation>'%1': Die Konturen nennen Scheiben von %#2 mm (Contour Slab Thickness); jede steht für %#3 mm; prüfen Sie das Volumen</translation>
    </message>
    <message>
        <source>'%1': its contours state slabs of %#2 mm (Contour Slab Thickness); each stands for %#3 mm, as far as they lie apart; check its volume</source>
        <translation>'%1': Die Konturen nennen Scheiben von %#2 mm (Contour Slab Thickness); jede steht für %#3 mm, so weit sie auseinander liegen; prüfen Sie das Volumen</translation>
    </message>
    <message>
        <source>describes a structure without a number, or two of one number; export it again</source>
        <translation>beschreibt eine Struktur ohne Nummer oder zwei mit gleicher; exportieren Sie sie neu</translation>
    </message>
    <message>
        <source>holds structures of several frames of reference; export those of each image in a file of their own</source>
        <translation>enthält Strukturen aus mehreren Bezugssystemen; exportieren Sie die jedes Bildes in eine eigene Datei</translation>
    </message>
    <message>
        <source>holds more than 65535 structures; export fewer at a time</source>
        <translation>enthält mehr als 65535 Strukturen; exportieren Sie weniger auf einmal</translation>
    </message>
    <message>
        <source>has contours of a structure that it does not describe; export it again</source>
        <translation>hat Konturen einer Struktur, die sie nicht beschreibt; exportieren Sie sie neu</translation>
    </message>
    <message>
        <source>describes the contours of one structure twice (ROI Contour Sequence), which may be two structures; export it again</source>
        <translation>beschreibt die Konturen einer Struktur zweimal (ROI Contour Sequence), was zwei Strukturen sein können; exportieren Sie sie neu</translation>
    </message>
    <message>
        <source>left of it</source>
        <translation>links davon</translation>
    </message>
    <message>
        <source>right of it</source>
        <translation>rechts davon</translation>
    </message>
    <message>
        <source>posterior to it</source>
        <translation>posterior davon</translation>
    </message>
    <message>
        <source>anterior to it</source>
        <translation>anterior davon</translation>
    </message>
    <message>
        <source>superior to it</source>
        <translation>superior davon</translation>
    </message>
    <message>
        <source>inferior to it</source>
        <translation>inferior davon</translation>
    </message>
    <message>
        <source>'%1': %#2 contour that is there twice in one plane was taken once</source>
        <translation>„%1“: %#2 Kontur, die in einer Ebene zweimal da ist, wurde einmal genommen</translation>
    </message>
    <message>
        <source>'%1': %#2 contours that are there twice in one plane were taken once</source>
        <translation>„%1“: %#2 Konturen, die in einer Ebene zweimal da sind, wurden einmal genommen</translation>
    </message>
    <message>
        <source>'%1' has contours that lie closely within each other in %#2 plane, where next to nothing is left between them (were they drawn twice?)</source>
        <translation>„%1“ hat in %#2 Ebene Konturen, die eng ineinander liegen und fast nichts zwischen sich lassen (wurden sie zweimal gezeichnet?)</translation>
    </message>
    <message>
        <source>'%1' has contours that lie closely within each other in %#2 planes, where next to nothing is left between them (were they drawn twice?)</source>
        <translation>„%1“ hat in %#2 Ebenen Konturen, die eng ineinander liegen und fast nichts zwischen sich lassen (wurden sie zweimal gezeichnet?)</translation>
    </message>
    <message>
        <source>'%1': %#2 % of it lies outside this image and became no voxels</source>
        <translation>„%1“: %#2 % davon liegen außerhalb dieses Bildes und wurden keine Voxel</translation>
    </message>
    <message>
        <source>'%1' has %#2 contour smaller than a voxel, which became one voxel each</source>
        <translation>„%1“ hat %#2 Kontur, kleiner als ein Voxel, die je ein Voxel wurde</translation>
    </message>
    <message>
        <source>'%1' has %#2 contours smaller than a voxel, which became one voxel each</source>
        <translation>„%1“ hat %#2 Konturen, kleiner als ein Voxel, die je ein Voxel wurden</translation>
    </message>
    <message>
        <source>'%1' is thinner than the voxels: those that it became lie on average %2 % within its contours and are scattered; its volume is right, its shape is not</source>
        <translation>„%1“ ist dünner als die Voxel: Die daraus wurden, liegen im Mittel zu %2 % innerhalb der Konturen und sind verstreut; das Volumen stimmt, die Form nicht</translation>
    </message>
    <message>
        <source>'%1' is thinner than the voxels: those that it became lie on average %2 % within its contours, and their volume is %#3 times that of the contours; neither it nor their shape is that of the structure</source>
        <translation>„%1“ ist dünner als die Voxel: Die daraus wurden, liegen im Mittel zu %2 % innerhalb der Konturen, und ihr Volumen ist das %#3-Fache dessen der Konturen; weder dieses noch ihre Form ist die der Struktur</translation>
    </message>
    <message>
        <source>its structures overlap in more layers than are read; export fewer of them at a time</source>
        <translation>die Strukturen überlappen sich in mehr Ebenen, als gelesen werden; exportieren Sie weniger auf einmal</translation>
    </message>
    <message>
        <source>has no closed contour in any structure; export it again with what was drawn</source>
        <translation>hat in keiner Struktur eine geschlossene Kontur; exportieren Sie neu, mit dem Gezeichneten</translation>
    </message>
    <message>
        <source>was drawn on planes oblique to this image's slices; resample the image or the contours where they were drawn, or export the structures as a segmentation</source>
        <translation>wurde auf Ebenen schräg zu den Schichten dieses Bildes gezeichnet; rechnen Sie Bild oder Konturen dort um, wo gezeichnet wurde, oder exportieren Sie die Strukturen als Segmentierung</translation>
    </message>
    <message>
        <source>lies wholly outside this image, its nearest contour %#1 mm %2; take the image on which it was drawn, or export it again with the contours of this one</source>
        <translation>liegt ganz außerhalb dieses Bildes, die nächste Kontur %#1 mm %2; nehmen Sie das Bild, auf dem gezeichnet wurde, oder exportieren Sie neu, mit den Konturen dieses Bildes</translation>
    </message>
    <message>
        <source>%~1 left out: drawn on planes oblique to this image's slices</source>
        <translation>%~1 blieb weg: auf Ebenen schräg zu den Schichten dieses Bildes gezeichnet</translation>
    </message>
    <message>
        <source>%~1: drawn on some of the slices only; each contour stands for the slices half-way to the next</source>
        <translation>%~1: nur auf einigen der Schichten gezeichnet; jede Kontur steht für die Schichten auf halbem Weg zur nächsten</translation>
    </message>
    <message>
        <source>%~1: contours of one plane cross each other; what two of them surround is outside, as within an inner contour</source>
        <translation>%~1: Konturen einer Ebene kreuzen einander; was zwei davon umschließen, gilt als außen, wie in einer inneren Kontur</translation>
    </message>
    <message>
        <source>%#1 point or open contour encloses nothing and became no voxels</source>
        <translation>%#1 Punkt oder offene Kontur umschließt nichts und wurde zu keinem Voxel</translation>
    </message>
    <message>
        <source>%#1 points and open contours enclose nothing and became no voxels</source>
        <translation>%#1 Punkte und offene Konturen umschließen nichts und wurden zu keinem Voxel</translation>
    </message>
</context>
<context>
    <name>Library</name>
    <message>
        <source>'%1' holds more than %#2 values</source>
        <translation>„%1“ enthält mehr als %#2 Werte</translation>
    </message>
    <message>
        <source>its threshold of bone is no intensity</source>
        <translation>seine Knochenschwelle ist keine Intensität</translation>
    </message>
    <message>
        <source>its values of soft tissue are no intensities</source>
        <translation>seine Werte des Weichgewebes sind keine Intensitäten</translation>
    </message>
    <message>
        <source>an image's least intensity is above its largest</source>
        <translation>die kleinste Intensität eines Bildes liegt über der größten</translation>
    </message>
    <message>
        <source>it has two MRs of one name</source>
        <translation>er hat zwei MR gleichen Namens</translation>
    </message>
    <message>
        <source>a part was drawn on an MR that it does not have</source>
        <translation>ein Teil wurde auf einem MR gezeichnet, das er nicht hat</translation>
    </message>
    <message>
        <source>it has two structures of one name</source>
        <translation>er hat zwei Strukturen gleichen Namens</translation>
    </message>
    <message>
        <source>two of its structures have one label, or one has none</source>
        <translation>zwei seiner Strukturen haben ein Label, oder eine hat keines</translation>
    </message>
    <message>
        <source>it has two meshes of one name</source>
        <translation>er hat zwei Netze gleichen Namens</translation>
    </message>
    <message>
        <source>the rotation of an MR is not a unit quaternion</source>
        <translation>die Drehung eines MR ist kein Einheitsquaternion</translation>
    </message>
    <message>
        <source>an MR is moved by more than 1 km</source>
        <translation>ein MR ist um mehr als 1 km verschoben</translation>
    </message>
    <message>
        <source>an image has a grid of more than three axes</source>
        <translation>ein Bild hat ein Gitter mit mehr als drei Achsen</translation>
    </message>
    <message>
        <source>an image is of an unknown modality</source>
        <translation>ein Bild ist von unbekannter Modalität</translation>
    </message>
    <message>
        <source>'%1' is not what its hash says</source>
        <translation>„%1“ ist nicht, was seine Prüfsumme sagt</translation>
    </message>
    <message>
        <source>it has a name that is not a valid one</source>
        <translation>er hat einen ungültigen Namen</translation>
    </message>
    <message>
        <source>it lacks '%1'</source>
        <translation>es fehlt „%1“</translation>
    </message>
    <message>
        <source>it lists '%1' twice</source>
        <translation>er führt „%1“ zweimal auf</translation>
    </message>
    <message>
        <source>'%1' cannot have the size that is stated</source>
        <translation>„%1“ kann die genannte Größe nicht haben</translation>
    </message>
    <message>
        <source>it states impossible sizes</source>
        <translation>er nennt unmögliche Größen</translation>
    </message>
    <message>
        <source>'%1' is not listed in it</source>
        <translation>„%1“ ist nicht darin aufgeführt</translation>
    </message>
    <message>
        <source>an attachment is a link to a file of another computer</source>
        <translation>eine Anlage ist eine Verknüpfung mit einer Datei eines anderen Rechners</translation>
    </message>
    <message>
        <source>%~1 has no valid name of an object</source>
        <translation>%~1 hat keinen gültigen Namen eines Objekts</translation>
    </message>
    <message>
        <source>it lacks %~1</source>
        <translation>es fehlt %~1</translation>
    </message>
    <message>
        <source>'%1' belongs to nothing in the case</source>
        <translation>„%1“ gehört zu nichts im Fall</translation>
    </message>
    <message>
        <source>'%1' is larger than stated</source>
        <translation>„%1“ ist größer als genannt</translation>
    </message>
    <message>
        <source>'%1' is damaged</source>
        <translation>„%1“ ist beschädigt</translation>
    </message>
    <message>
        <source>an object</source>
        <translation>ein Objekt</translation>
    </message>
    <message>
        <source>%1: the case needs %#2 MB, %#3 MB are free; nothing was restored; free some space</source>
        <translation>%1: Der Fall braucht %#2 MB, %#3 MB sind frei; nichts wurde wiederhergestellt; schaffen Sie Platz</translation>
    </message>
    <message>
        <source>%~1 does not lie where its voxels say</source>
        <translation>%~1 liegt nicht, wo die Voxel es sagen</translation>
    </message>
    <message>
        <source>an image has not the intensities that are stated</source>
        <translation>ein Bild hat nicht die angegebenen Intensitäten</translation>
    </message>
    <message>
        <source>an image cannot be read</source>
        <translation>ein Bild kann nicht gelesen werden</translation>
    </message>
    <message>
        <source>a structure is not in its label map</source>
        <translation>eine Struktur ist nicht in ihrer Labelkarte</translation>
    </message>
    <message>
        <source>a structure is larger than its label map</source>
        <translation>eine Struktur ist größer als ihre Labelkarte</translation>
    </message>
    <message>
        <source>a stroke removed more than its voxels hold</source>
        <translation>ein Zug trug mehr ab, als seine Voxel enthalten</translation>
    </message>
    <message>
        <source>a label map cannot be read</source>
        <translation>eine Labelkarte ist nicht lesbar</translation>
    </message>
    <message>
        <source>a mesh cannot be read</source>
        <translation>ein Netz ist nicht lesbar</translation>
    </message>
    <message>
        <source>an instrument cannot be read</source>
        <translation>ein Instrument ist nicht lesbar</translation>
    </message>
    <message>
        <source>what a stroke removed cannot be read</source>
        <translation>was ein Bohrzug abtrug, ist nicht lesbar</translation>
    </message>
    <message>
        <source>a stroke removes what was removed before</source>
        <translation>ein Bohrzug trägt ab, was schon abgetragen war</translation>
    </message>
    <message>
        <source>an attachment is not of the kind or size that is stated</source>
        <translation>eine Anlage ist nicht von der genannten Art oder Größe</translation>
    </message>
    <message>
        <source>the archive states another number of voxels, or another volume, of %~1 than the label map has; they were computed from its voxels</source>
        <translation>das Archiv nennt von %~1 eine andere Zahl von Voxeln oder ein anderes Volumen, als die Labelkarte hat; sie wurden aus deren Voxeln berechnet</translation>
    </message>
    <message>
        <source>the archive states another number of triangles of %~1 than the mesh has; they were counted</source>
        <translation>das Archiv nennt von %~1 eine andere Zahl von Dreiecken, als das Netz hat; sie wurden gezählt</translation>
    </message>
    <message>
        <source>its thumbnail is not one</source>
        <translation>sein Vorschaubild ist keines</translation>
    </message>
    <message>
        <source>left out, since a plan brings no voxels; add it to the case</source>
        <translation>blieb weg, da ein Plan keine Voxel mitbringt; fügen Sie es dem Fall hinzu</translation>
    </message>
    <message>
        <source>%~1: left out with MR '%2', on which it was drawn; add both to the case</source>
        <translation>%~1: blieb weg mit dem MR „%2“, auf dem gezeichnet wurde; fügen Sie beides dem Fall hinzu</translation>
    </message>
    <message>
        <source>structures %1</source>
        <translation>Strukturen %1</translation>
    </message>
    <message>
        <source>mesh '%1'</source>
        <translation>Netz „%1“</translation>
    </message>
    <message>
        <source>the plan is of another patient than that of case '%1', whose image has the very same voxels, by what their files state; it fits, but make sure whose images these are</source>
        <translation>der Plan ist nach den Angaben der Dateien von einem anderen Patienten als dem des Falls '%1', dessen Bild genau dieselben Voxel hat; er passt, aber stellen Sie sicher, wessen Bilder es sind</translation>
    </message>
    <message>
        <source>whether the plan is of the patient of case '%1', whose image has the very same voxels, cannot be told, as it comes from another library; make sure that it is</source>
        <translation>ob der Plan vom Patienten des Falls '%1' ist, dessen Bild genau dieselben Voxel hat, lässt sich nicht sagen, da er aus einer anderen Bibliothek kommt; stellen Sie sicher, dass er es ist</translation>
    </message>
    <message>
        <source>%1: was written by a newer version of this program; update it</source>
        <translation>%1: wurde mit einer neueren Version dieses Programms geschrieben; aktualisieren Sie es</translation>
    </message>
    <message>
        <source>its format is unknown</source>
        <translation>das Format ist unbekannt</translation>
    </message>
    <message>
        <source>'%1' cannot be read</source>
        <translation>„%1“ ist nicht lesbar</translation>
    </message>
    <message>
        <source>case '%1' is there already in %2; give the restored one another name (--as NAME)</source>
        <translation>ein Fall „%1“ ist schon in %2; stellen Sie unter einem anderen Namen wieder her</translation>
    </message>
    <message>
        <source>the plan of case '%1'</source>
        <translation>der Plan des Falls „%1“</translation>
    </message>
    <message>
        <source>%1: %2 was made on another CT than that of case '%3'; import the very same series, with the same region and repair, and give that case</source>
        <translation>%1: %2 wurde auf einem anderen CT erstellt als dem des Falls „%3“; importieren Sie genau dieselbe Serie mit gleichem Bereich und gleicher Reparatur, und nehmen Sie diesen Fall</translation>
    </message>
    <message>
        <source>%1: %2 brings no voxels, and its CT is not in this library; import the same series into a case first, or ask for a whole archive</source>
        <translation>%1: %2 bringt keine Voxel mit, und das CT ist nicht in dieser Bibliothek; importieren Sie dieselbe Serie erst in einen Fall, oder bitten Sie um ein vollständiges Archiv</translation>
    </message>
    <message>
        <source>%1: has a CT of its own; --ct is for an archive of a plan</source>
        <translation>%1: hat ein eigenes CT; eines dazuzugeben gilt dem Archiv eines Plans</translation>
    </message>
    <message>
        <source>its thumbnail could not be kept; check the disk</source>
        <translation>sein Vorschaubild ließ sich nicht behalten; prüfen Sie den Datenträger</translation>
    </message>
    <message>
        <source>%1: is no image as this program stores it; 'petrous library verify' lists what is damaged</source>
        <translation>%1: ist kein Bild, wie dieses Programm es speichert</translation>
    </message>
    <message>
        <source>%1: cannot be read to its end</source>
        <translation>%1: lässt sich nicht bis zum Ende lesen</translation>
    </message>
    <message>
        <source>%1: changed while it was read; try again</source>
        <translation>%1: änderte sich beim Lesen; versuchen Sie es noch einmal</translation>
    </message>
    <message>
        <source>larger than can be embedded</source>
        <translation>größer, als eingebettet werden kann</translation>
    </message>
    <message>
        <source>changed</source>
        <translation>verändert</translation>
    </message>
    <message>
        <source>damaged</source>
        <translation>beschädigt</translation>
    </message>
    <message>
        <source>too large for its metadata to be removed</source>
        <translation>zu groß, um die Metadaten zu entfernen</translation>
    </message>
    <message>
        <source>no PNG whose metadata can be removed</source>
        <translation>kein PNG, aus dem sich Metadaten entfernen lassen</translation>
    </message>
    <message>
        <source>the instrument</source>
        <translation>das Instrument</translation>
    </message>
    <message>
        <source>the instrument is not in the archive: its file is damaged or missing</source>
        <translation>das Instrument ist nicht im Archiv: Seine Datei ist beschädigt oder fehlt</translation>
    </message>
    <message>
        <source>%~1 stays in this library: a plan takes small screenshots and recordings along</source>
        <translation>%~1 bleibt in dieser Bibliothek: Ein Plan nimmt kleine Bildschirmfotos und Aufzeichnungen mit</translation>
    </message>
    <message>
        <source>%~1 stays in this library: a video may show or name the patient (--with-videos takes it along)</source>
        <translation>%~1 bleibt in dieser Bibliothek: Ein Video kann den Patienten zeigen oder nennen (ein Häkchen im Dialog nimmt es mit)</translation>
    </message>
    <message>
        <source>%~1 stays in this library: a PDF may name the patient, also in its metadata (--with-documents takes it along)</source>
        <translation>%~1 bleibt in dieser Bibliothek: Ein PDF kann den Patienten nennen, auch in den Metadaten (ein Häkchen im Dialog nimmt es mit)</translation>
    </message>
    <message>
        <source>%~1 is not in the archive: its file is %~2</source>
        <translation>%~1 ist nicht im Archiv: Die Datei ist %~2</translation>
    </message>
    <message>
        <source>attachments go along under their names; see that they show and name nobody</source>
        <translation>Anlagen gehen mit ihren Namen mit; sehen Sie nach, dass sie niemanden zeigen oder nennen</translation>
    </message>
    <message>
        <source>metadata is not removed from %1</source>
        <translation>Metadaten werden nicht entfernt aus %1</translation>
    </message>
    <message>
        <source>who signed a registration, and when, stays in this library; that it was signed goes along</source>
        <translation>wer eine Registrierung freigab, und wann, bleibt in dieser Bibliothek; dass sie freigegeben ist, geht mit</translation>
    </message>
    <message>
        <source>archive: the level of compression is 1 to 12</source>
        <translation>Archiv: die Stufe der Kompression ist 1 bis 12</translation>
    </message>
    <message>
        <source>structures of case '%1'</source>
        <translation>Strukturen des Falls „%1“</translation>
    </message>
    <message>
        <source>the planned date stays in this library</source>
        <translation>das geplante Datum bleibt in dieser Bibliothek</translation>
    </message>
    <message>
        <source>the note stays in this library</source>
        <translation>die Notiz bleibt in dieser Bibliothek</translation>
    </message>
    <message>
        <source>the note goes along as it was typed; see that it names nobody</source>
        <translation>die Notiz geht mit, wie sie eingegeben wurde; sehen Sie nach, dass sie niemanden nennt</translation>
    </message>
    <message>
        <source>%#1 note on the import names what the case does not have, or calls otherwise by now, and stays in this library</source>
        <translation>%#1 Vermerk vom Import nennt, was der Fall nicht hat oder inzwischen anders nennt, und bleibt in dieser Bibliothek</translation>
    </message>
    <message>
        <source>%#1 notes on the import name what the case does not have, or calls otherwise by now, and stay in this library</source>
        <translation>%#1 Vermerke vom Import nennen, was der Fall nicht hat oder inzwischen anders nennt, und bleiben in dieser Bibliothek</translation>
    </message>
    <message>
        <source>a name of no or too many bytes</source>
        <translation>ein Name von keinem oder zu vielen Byte</translation>
    </message>
    <message>
        <source>a name that is no relative path</source>
        <translation>ein Name, der kein relativer Pfad ist</translation>
    </message>
    <message>
        <source>a name that leads out of its folder</source>
        <translation>ein Name, der aus dem Ordner hinausführt</translation>
    </message>
    <message>
        <source>control characters in a name</source>
        <translation>Steuerzeichen in einem Namen</translation>
    </message>
    <message>
        <source>%1: is not a sound archive of a case: %~2; nothing was restored; get the file again from where it was made</source>
        <translation>%1: ist kein unversehrtes Archiv eines Falls: %~2; nichts wurde wiederhergestellt; holen Sie die Datei noch einmal von dort, wo sie entstand</translation>
    </message>
    <message>
        <source>zip entry '%1': is there already</source>
        <translation>Zip-Eintrag „%1“: ist schon da</translation>
    </message>
    <message>
        <source>it is no zip file, or is cut short</source>
        <translation>sie ist keine Zip-Datei oder abgeschnitten</translation>
    </message>
    <message>
        <source>its directory contradicts its entries</source>
        <translation>ihr Verzeichnis widerspricht ihren Einträgen</translation>
    </message>
    <message>
        <source>it has two entries of one name</source>
        <translation>sie hat zwei Einträge gleichen Namens</translation>
    </message>
    <message>
        <source>it cannot be read</source>
        <translation>sie ist nicht lesbar</translation>
    </message>
    <message>
        <source>it has more entries than a case can have</source>
        <translation>sie hat mehr Einträge, als ein Fall haben kann</translation>
    </message>
    <message>
        <source>entry %#1</source>
        <translation>Eintrag %#1</translation>
    </message>
    <message>
        <source>%1 is not described completely</source>
        <translation>%1 ist nicht vollständig beschrieben</translation>
    </message>
    <message>
        <source>%1 has %~2</source>
        <translation>%1 hat %~2</translation>
    </message>
    <message>
        <source>%1 is encrypted</source>
        <translation>%1 ist verschlüsselt</translation>
    </message>
    <message>
        <source>%1 is compressed by an unknown method</source>
        <translation>%1 ist mit einem unbekannten Verfahren komprimiert</translation>
    </message>
    <message>
        <source>%1 is a link or a device</source>
        <translation>%1 ist eine Verknüpfung oder ein Gerät</translation>
    </message>
    <message>
        <source>%1 is a folder with content</source>
        <translation>%1 ist ein Ordner mit Inhalt</translation>
    </message>
    <message>
        <source>%1 states a size that it cannot have</source>
        <translation>%1 nennt eine unmögliche Größe</translation>
    </message>
    <message>
        <source>'%1' is larger than any that this program writes</source>
        <translation>„%1“ ist größer als alles, was dieses Programm schreibt</translation>
    </message>
    <message>
        <source>'%1' has not the size that it states</source>
        <translation>„%1“ hat nicht die genannte Größe</translation>
    </message>
    <message>
        <source>case '%1' cannot be saved, as of what it needs the library has lost %2 (removed by another program, or by hand); restore the library's files from a copy, or take out of the case what is lost, and save again</source>
        <translation>der Fall „%1“ kann nicht gespeichert werden, da die Bibliothek von dem, was er braucht, %2 verloren hat (von einem anderen Programm oder von Hand entfernt); stellen Sie die Dateien der Bibliothek aus einer Kopie wieder her, oder nehmen Sie das Verlorene aus dem Fall, und speichern Sie erneut</translation>
    </message>
    <message>
        <source>and %#1 more structures</source>
        <translation>und %#1 weitere Strukturen</translation>
    </message>
    <message>
        <source>structure %1 of case '%2'</source>
        <translation>Struktur %1 des Falls „%2“</translation>
    </message>
    <message>
        <source>a label map%1 of case '%2'</source>
        <translation>eine Labelkarte%1 des Falls „%2“</translation>
    </message>
    <message>
        <source>the label map of %1 of case '%2'</source>
        <translation>die Labelkarte von %1 des Falls „%2“</translation>
    </message>
    <message>
        <source>mesh '%1' of case '%2'</source>
        <translation>Netz „%1“ des Falls „%2“</translation>
    </message>
    <message>
        <source>MR '%1' of case '%2'</source>
        <translation>MR „%1“ des Falls „%2“</translation>
    </message>
    <message>
        <source>the MR of case '%1'</source>
        <translation>das MR des Falls „%1“</translation>
    </message>
    <message>
        <source>the CT of case '%1'</source>
        <translation>das CT des Falls „%1“</translation>
    </message>
    <message>
        <source>labels %#1 %2</source>
        <translation>Labels %#1 %2</translation>
    </message>
    <message>
        <source>listing the cases</source>
        <translation>Fälle werden aufgelistet</translation>
    </message>
    <message>
        <source>case '%1' is open in Petrous elsewhere (%~2); %~3</source>
        <translation>Der Fall „%1“ ist anderswo in Petrous geöffnet (%~2); %~3</translation>
    </message>
    <message>
        <source>no case '%1' in %2; the library is empty</source>
        <translation>kein Fall „%1“ in %2; die Bibliothek ist leer</translation>
    </message>
    <message>
        <source>no case '%1' in %2; there are: %3</source>
        <translation>kein Fall „%1“ in %2; es gibt: %3</translation>
    </message>
    <message>
        <source>date: must be a day as YYYY-MM-DD, e.g. 2026-03-31</source>
        <translation>Datum: muss ein Tag als JJJJ-MM-TT sein, z. B. 2026-03-31</translation>
    </message>
    <message>
        <source>dates: the first is later than the last</source>
        <translation>Daten: das erste liegt nach dem letzten</translation>
    </message>
    <message>
        <source>searching the notes</source>
        <translation>Notizen werden durchsucht</translation>
    </message>
    <message>
        <source>case '%1' was renamed '%2' and changed by another program since it was opened; open it again and repeat what you did</source>
        <translation>der Fall „%1“ wurde von einem anderen Programm in „%2“ umbenannt und geändert, seit er geöffnet wurde; öffnen Sie ihn neu, und wiederholen Sie Ihre Arbeit</translation>
    </message>
    <message>
        <source>case '%1' was changed by another program since it was opened; open it again and repeat what you did</source>
        <translation>der Fall „%1“ wurde von einem anderen Programm geändert, seit er geöffnet wurde; öffnen Sie ihn neu, und wiederholen Sie Ihre Arbeit</translation>
    </message>
    <message>
        <source>case '%1' was deleted by another program since it was opened, and another case has its name; save it under another name</source>
        <translation>der Fall „%1“ wurde von einem anderen Programm gelöscht, seit er geöffnet wurde, und ein anderer Fall hat seinen Namen; speichern Sie ihn unter einem anderen Namen</translation>
    </message>
    <message>
        <source>case '%1' was deleted by another program since it was opened; bring it back ('petrous library undelete'), or save it under another name</source>
        <translation>der Fall „%1“ wurde von einem anderen Programm gelöscht, seit er geöffnet wurde; holen Sie ihn zurück („Zurückholen“ in der Bibliothek), oder speichern Sie ihn unter einem anderen Namen</translation>
    </message>
    <message>
        <source>case '%1' is there already in %2; choose another name</source>
        <translation>ein Fall „%1“ ist schon in %2; wählen Sie einen anderen Namen</translation>
    </message>
    <message>
        <source>case '%1' is there already in %2; choose another name than '%3', which reads the same</source>
        <translation>ein Fall „%1“ ist schon in %2; wählen Sie einen anderen Namen als „%3“, der gleich aussieht</translation>
    </message>
    <message>
        <source>%~1. Saving the case accepts it as it is, as 'petrous library repair --accept-changed' does</source>
        <translation>%~1. Wer den Fall speichert, nimmt ihn so an, wie er ist; „petrous library repair --accept-changed“ tut dasselbe</translation>
    </message>
    <message>
        <source>the instrument of case '%1'</source>
        <translation>das Instrument des Falls „%1“</translation>
    </message>
    <message>
        <source>stroke %#1 of case '%2'</source>
        <translation>Bohrzug %#1 des Falls „%2“</translation>
    </message>
    <message>
        <source>%~1; or go back to before it, which loses nothing: petrous undo '%2' %#3</source>
        <translation>%~1; oder nehmen Sie die Bohrzüge ab ihm zurück, wobei nichts verloren geht (Fall „%2“, %#3)</translation>
    </message>
    <message>
        <source>checking structures</source>
        <translation>Strukturen werden geprüft</translation>
    </message>
    <message>
        <source>%~1; %#2 more is missing or damaged</source>
        <translation>%~1; %#2 weiteres fehlt oder ist beschädigt</translation>
    </message>
    <message>
        <source>%~1; %#2 more are missing or damaged</source>
        <translation>%~1; %#2 weitere fehlen oder sind beschädigt</translation>
    </message>
    <message>
        <source>leaving %~1 %2</source>
        <translation>%~1 wird weggelassen: %2</translation>
    </message>
    <message>
        <source>birth date</source>
        <translation>Geburtsdatum</translation>
    </message>
    <message>
        <source>MR '%1' was acquired in the CT's position, which the library that it comes to cannot know; register it</source>
        <translation>das MR „%1“ wurde in der Lage des CT aufgenommen, was die Bibliothek, in die es kommt, nicht wissen kann; registrieren Sie es</translation>
    </message>
    <message>
        <source>what is changed there is not saved over this: open it there again</source>
        <translation>was dort geändert wird, überschreibt dies nicht: Öffnen Sie ihn dort neu</translation>
    </message>
    <message>
        <source>case '%1' is as it was</source>
        <translation>der Fall „%1“ ist, wie er war</translation>
    </message>
    <message>
        <source>case '%1' is not kept</source>
        <translation>der Fall „%1“ wird nicht behalten</translation>
    </message>
    <message>
        <source>case '%1' was renamed by another program since it was opened, and was saved under its new name, '%2'</source>
        <translation>der Fall „%1“ wurde von einem anderen Programm umbenannt, seit er geöffnet wurde, und unter seinem neuen Namen gespeichert, „%2“</translation>
    </message>
    <message>
        <source>case '%1' is saved, but the disk reported an error; check the disk</source>
        <translation>der Fall „%1“ ist gespeichert, aber der Datenträger meldete einen Fehler; prüfen Sie ihn</translation>
    </message>
    <message>
        <source>case '%1' was changed by another program meanwhile; what was drilled was added to it, on branch '%2'</source>
        <translation>der Fall „%1“ wurde inzwischen von einem anderen Programm geändert; das Gebohrte kam hinzu, auf dem Zugang „%2“</translation>
    </message>
    <message>
        <source>%1 drilled %#2</source>
        <translation>%1 gebohrt %#2</translation>
    </message>
    <message>
        <source>case '%1' was removed or changed by another program meanwhile so that what was drilled does not fit; it was saved as case '%2'</source>
        <translation>der Fall „%1“ wurde inzwischen von einem anderen Programm entfernt oder so geändert, dass das Gebohrte nicht passt; er wurde als Fall „%2“ gespeichert</translation>
    </message>
    <message>
        <source>case '%1' is being drilled by another process; end that first</source>
        <translation>am Fall „%1“ bohrt ein anderer Prozess; beenden Sie diesen erst</translation>
    </message>
    <message>
        <source>case '%1': %2 holds what a session drilled and did not save; open the case first, which brings it back or says why it cannot, then rename it</source>
        <translation>Fall „%1“: %2 enthält, was eine Sitzung bohrte und nicht speicherte; öffnen Sie den Fall erst, was es zurückbringt oder sagt, warum nicht, und benennen Sie ihn dann um</translation>
    </message>
    <message>
        <source>case '%1' is renamed, but the disk reported an error; check the disk</source>
        <translation>der Fall „%1“ ist umbenannt, aber der Datenträger meldete einen Fehler; prüfen Sie ihn</translation>
    </message>
    <message>
        <source>what is changed there is saved under this name</source>
        <translation>was dort geändert wird, wird unter diesem Namen gespeichert</translation>
    </message>
    <message>
        <source>%1: is a folder; remove it by hand</source>
        <translation>%1: ist ein Ordner; entfernen Sie ihn von Hand</translation>
    </message>
    <message>
        <source>case '%1' is deleted, but the disk reported an error; check the disk</source>
        <translation>der Fall „%1“ ist gelöscht, aber der Datenträger meldete einen Fehler; prüfen Sie ihn</translation>
    </message>
    <message>
        <source>case '%1' is open in Petrous elsewhere (%~2), and deleted all the same; what is changed there cannot be saved unless the case is brought back</source>
        <translation>Der Fall „%1“ ist anderswo in Petrous geöffnet (%~2) und wurde trotzdem gelöscht; was dort geändert wird, kann nicht gespeichert werden, außer der Fall wird zurückgeholt</translation>
    </message>
    <message>
        <source>no case '%1' was deleted here</source>
        <translation>hier wurde kein Fall „%1“ gelöscht</translation>
    </message>
    <message>
        <source>there are: %1</source>
        <translation>es gibt: %1</translation>
    </message>
    <message>
        <source>no deleted case '%1' in %2 can be brought back%3</source>
        <translation>kein gelöschter Fall „%1“ in %2 lässt sich zurückholen%3</translation>
    </message>
    <message>
        <source>case '%1' is there already in %2; rename that one, then bring the other back</source>
        <translation>ein Fall „%1“ ist schon in %2; benennen Sie erst diesen um (F2 in der Bibliothek), und holen Sie dann den anderen zurück</translation>
    </message>
    <message>
        <source>%~1; deleted case '%2' cannot be brought back as it is, and stays deleted</source>
        <translation>%~1; der gelöschte Fall „%2“ lässt sich nicht zurückholen, wie er ist, und bleibt gelöscht</translation>
    </message>
    <message>
        <source>case '%1' is back, but the disk reported an error; check the disk</source>
        <translation>der Fall „%1“ ist zurück, aber der Datenträger meldete einen Fehler; prüfen Sie ihn</translation>
    </message>
    <message>
        <source>case '%1' was changed by another program while it was copied; copy it again</source>
        <translation>der Fall „%1“ wurde von einem anderen Programm geändert, während er kopiert wurde; kopieren Sie ihn noch einmal</translation>
    </message>
    <message>
        <source>attachment '%1' of case '%2' is lost: attach the same file again, which puts it back, or take it out ('petrous attachments %3 --remove')</source>
        <translation>die Anlage „%1“ des Falls „%2“ ist verloren: Hängen Sie dieselbe Datei noch einmal an, was sie zurückbringt, oder nehmen Sie sie heraus (Anlagen, F12; Fall %3)</translation>
    </message>
    <message>
        <source>of no case</source>
        <translation>keines Falls</translation>
    </message>
    <message>
        <source>%~1 of deleted case '%2'</source>
        <translation>%~1 des gelöschten Falls „%2“</translation>
    </message>
    <message>
        <source>%~1 of case '%2'</source>
        <translation>%~1 des Falls „%2“</translation>
    </message>
    <message>
        <source>needed by: '%1' (deleted)</source>
        <translation>gebraucht von: „%1“ (gelöscht)</translation>
    </message>
    <message>
        <source>needed by: '%1'</source>
        <translation>gebraucht von: „%1“</translation>
    </message>
    <message>
        <source>the salt with which its marks of patient and frame of reference were made is lost; restore it from a copy, or import the images again: until then nothing tells whether a new image is of the same patient, and names that may be the patient's are withheld where the case leaves</source>
        <translation>das Salt, mit dem seine Kennzeichen von Patient und Bezugssystem gebildet wurden, ist verloren; stellen Sie es aus einer Kopie wieder her oder importieren Sie die Bilder neu: Bis dahin sagt nichts, ob ein neues Bild vom selben Patienten ist, und Namen, die die des Patienten sein können, werden zurückgehalten, wo der Fall das Haus verlässt</translation>
    </message>
    <message>
        <source>%1: cannot be opened under the name of this file, and no case can have it; rename the file (%~2)</source>
        <translation>%1: lässt sich unter dem Namen dieser Datei nicht öffnen, den kein Fall haben kann; benennen Sie die Datei um (%~2)</translation>
    </message>
    <message>
        <source>%~1; deleted case '%2' cannot be brought back</source>
        <translation>%~1; der gelöschte Fall „%2“ lässt sich nicht zurückholen</translation>
    </message>
    <message>
        <source>%1: the thumbnail of case '%2' is damaged; make it anew: petrous describe '%3' --thumbnail</source>
        <translation>%1: das Vorschaubild des Falls „%2“ ist beschädigt; erstellen Sie das von „%3“ neu (Bibliothek &gt; Vorschaubilder zeichnen)</translation>
    </message>
    <message>
        <source>%~1: is missing, or not what this program wrote; restore it from a copy: without it nothing tells whether a new image is of the patient of an older one</source>
        <translation>%~1: fehlt oder ist nicht, was dieses Programm geschrieben hat; stellen Sie es aus einer Kopie wieder her: Ohne es ist nicht zu erkennen, ob ein neues Bild vom Patienten eines älteren ist</translation>
    </message>
    <message>
        <source>%1: attachment '%2' of case '%3': the linked file is another one than was attached; put the former one back, or remove the attachment and attach this one</source>
        <translation>%1: Anhang „%2“ des Falls „%3“: Die verknüpfte Datei ist eine andere als die angehängte; legen Sie die frühere zurück, oder entfernen Sie den Anhang und hängen Sie diese an</translation>
    </message>
    <message>
        <source>a case of the library is open in Petrous elsewhere (%~1), where what was removed can still be put back; nothing was cleaned up: close it there first. Where no such program runs any more, remove what is in the library's folder 'open'</source>
        <translation>ein Fall der Bibliothek ist anderswo in Petrous geöffnet (%~1), wo Entferntes noch zurückgeholt werden kann; nichts wurde aufgeräumt: Schließen Sie ihn dort zuerst. Wo kein solches Programm mehr läuft, entfernen Sie, was im Ordner „open“ der Bibliothek liegt</translation>
    </message>
    <message>
        <source>reading cases</source>
        <translation>Fälle werden gelesen</translation>
    </message>
    <message>
        <source>%~1; what case '%2' needs is not known, so nothing was removed: clean up with that version</source>
        <translation>%~1; was der Fall „%2“ braucht, ist nicht bekannt, daher wurde nichts entfernt: räumen Sie mit jener Version auf</translation>
    </message>
    <message>
        <source>%~1; what case '%2' needs is not known, so nothing was removed: delete the case first, or restore its manifest</source>
        <translation>%~1; was der Fall „%2“ braucht, ist nicht bekannt, daher wurde nichts entfernt: Löschen Sie den Fall erst, oder stellen Sie sein Manifest wieder her</translation>
    </message>
    <message>
        <source>removing deleted cases</source>
        <translation>gelöschte Fälle werden entfernt</translation>
    </message>
    <message>
        <source>removing what no case needs</source>
        <translation>entfernt wird, was kein Fall braucht</translation>
    </message>
    <message>
        <source>case '%1' is saved anew as its file says</source>
        <translation>der Fall „%1“ ist neu gespeichert, wie seine Datei es sagt</translation>
    </message>
    <message>
        <source>case '%1': %~2</source>
        <translation>Fall „%1“: %~2</translation>
    </message>
    <message>
        <source>the index holds %#1 of %#2 cases</source>
        <translation>das Verzeichnis enthält %#1 von %#2 Fällen</translation>
    </message>
    <message>
        <source>%1: the file of case '%2' was changed outside of Petrous, or is damaged: it does not have the checksum that it states. Where images and structures lie, how an MR is registered and all else in it may be wrong: do not rely on it before you have compared it with a copy of the library, or restored it from there</source>
        <translation>%1: die Datei des Falls „%2“ wurde außerhalb von Petrous geändert oder ist beschädigt: Sie hat nicht die Prüfsumme, die sie angibt. Wo Bilder und Strukturen liegen, wie ein MR registriert ist und alles andere darin kann falsch sein: Verlassen Sie sich nicht darauf, bevor Sie sie mit einer Kopie der Bibliothek verglichen oder von dort wiederhergestellt haben</translation>
    </message>
    <message>
        <source>which is the instrument, too</source>
        <translation>das auch das Instrument ist</translation>
    </message>
    <message>
        <source>%1: %~2 of case '%3' does not lie where its voxels say: what is placed by it may be wrong; restore the file from a copy of the library, or import the images again</source>
        <translation>%1: %~2 des Falls „%3“ liegt nicht, wo die Voxel es sagen: Was danach platziert wird, kann falsch liegen; stellen Sie die Datei aus einer Kopie der Bibliothek wieder her, oder importieren Sie die Bilder noch einmal</translation>
    </message>
    <message>
        <source>%1: cannot be read (%~2); give the library's folder and check its permissions</source>
        <translation>%1: lässt sich nicht lesen (%~2); nennen Sie den Ordner der Bibliothek, und prüfen Sie die Rechte</translation>
    </message>
    <message>
        <source>case '%1' was removed, and another process is still drilling in it; end that first</source>
        <translation>der Fall „%1“ wurde entfernt, und ein anderer Prozess bohrt noch darin; beenden Sie diesen erst</translation>
    </message>
    <message>
        <source>%1: is not what this program wrote; restore it from a copy, or remove it (a new image's frame of reference is then not known to be that of older ones)</source>
        <translation>%1: ist nicht, was dieses Programm schrieb; stellen Sie sie aus einer Kopie wieder her, oder entfernen Sie sie (vom Bezugssystem eines neuen Bildes ist dann nicht bekannt, ob es das älterer ist)</translation>
    </message>
    <message>
        <source>libsodium cannot be initialised</source>
        <translation>libsodium lässt sich nicht initialisieren</translation>
    </message>
    <message>
        <source>a folder in it cannot be read</source>
        <translation>ein Ordner darin lässt sich nicht lesen</translation>
    </message>
    <message>
        <source>%1: lies within the input; name a place outside of it</source>
        <translation>%1: liegt in der Eingabe; nennen Sie einen Ort außerhalb</translation>
    </message>
    <message>
        <source>%1: holds no DICOM file that can be de-identified</source>
        <translation>%1: enthält keine DICOM-Datei, die sich de-identifizieren lässt</translation>
    </message>
    <message>
        <source>%1: holds no DICOM file that can be de-identified; the first %2</source>
        <translation>%1: enthält keine DICOM-Datei, die sich de-identifizieren lässt; die erste %2</translation>
    </message>
    <message>
        <source>de-identifying %#1 of %#2 files</source>
        <translation>%#1 von %#2 Dateien werden de-identifiziert</translation>
    </message>
    <message>
        <source>kept: block of safe private attributes</source>
        <translation>behalten: Block sicherer privater Attribute</translation>
    </message>
    <message>
        <source>kept: safe private attribute</source>
        <translation>behalten: sicheres privates Attribut</translation>
    </message>
    <message>
        <source>removed: private</source>
        <translation>entfernt: privat</translation>
    </message>
    <message>
        <source>removed%~1</source>
        <translation>entfernt%~1</translation>
    </message>
    <message>
        <source>items in place of a value, or the reverse</source>
        <translation>Items anstelle eines Wertes, oder umgekehrt</translation>
    </message>
    <message>
        <source>group length</source>
        <translation>Gruppenlänge</translation>
    </message>
    <message>
        <source>command or file meta information</source>
        <translation>Kommando- oder Datei-Metainformation</translation>
    </message>
    <message>
        <source>kept by option, cleaned within</source>
        <translation>auf Wunsch behalten, innen bereinigt</translation>
    </message>
    <message>
        <source>kept by option</source>
        <translation>auf Wunsch behalten</translation>
    </message>
    <message>
        <source>cleaned: words of the vocabulary stay</source>
        <translation>bereinigt: Wörter des Vokabulars bleiben</translation>
    </message>
    <message>
        <source>not a UID</source>
        <translation>keine UID</translation>
    </message>
    <message>
        <source>replaced by a new UID</source>
        <translation>durch eine neue UID ersetzt</translation>
    </message>
    <message>
        <source>emptied</source>
        <translation>geleert</translation>
    </message>
    <message>
        <source>replaced by a pseudonym</source>
        <translation>durch ein Pseudonym ersetzt</translation>
    </message>
    <message>
        <source>replaced by a dummy</source>
        <translation>durch einen Platzhalter ersetzt</translation>
    </message>
    <message>
        <source>date shifted</source>
        <translation>Datum verschoben</translation>
    </message>
    <message>
        <source>removed: not a time</source>
        <translation>entfernt: keine Uhrzeit</translation>
    </message>
    <message>
        <source>removed: not in the standard's dictionary</source>
        <translation>entfernt: nicht im Wörterbuch des Standards</translation>
    </message>
    <message>
        <source>removed: not of the attribute's VR</source>
        <translation>entfernt: nicht von der VR des Attributs</translation>
    </message>
    <message>
        <source>kept, cleaned within</source>
        <translation>behalten, innen bereinigt</translation>
    </message>
    <message>
        <source>kept: number</source>
        <translation>behalten: Zahl</translation>
    </message>
    <message>
        <source>removed: more values than it may have, or text in place of numbers</source>
        <translation>entfernt: mehr Werte als erlaubt, oder Text anstelle von Zahlen</translation>
    </message>
    <message>
        <source>kept: voxels or geometry</source>
        <translation>behalten: Voxel oder Geometrie</translation>
    </message>
    <message>
        <source>removed: bytes that are not needed</source>
        <translation>entfernt: nicht benötigte Bytes</translation>
    </message>
    <message>
        <source>kept: UID of the standard</source>
        <translation>behalten: UID des Standards</translation>
    </message>
    <message>
        <source>emptied: not a number, or an identifier of the patient</source>
        <translation>geleert: keine Zahl, oder eine Kennung des Patienten</translation>
    </message>
    <message>
        <source>removed: not a defined term</source>
        <translation>entfernt: kein definierter Begriff</translation>
    </message>
    <message>
        <source>coded string: a dummy for what is no defined term</source>
        <translation>kodierte Zeichenkette: ein Platzhalter für das, was kein definierter Begriff ist</translation>
    </message>
    <message>
        <source>kept: defined terms, or words of the vocabulary</source>
        <translation>behalten: definierte Begriffe, oder Wörter des Vokabulars</translation>
    </message>
    <message>
        <source>kept: empty</source>
        <translation>behalten: leer</translation>
    </message>
    <message>
        <source>kept: known manufacturer</source>
        <translation>behalten: bekannter Hersteller</translation>
    </message>
    <message>
        <source>kept: code or unit of a known form</source>
        <translation>behalten: Code oder Einheit in bekannter Form</translation>
    </message>
    <message>
        <source>the pixel data do not match rows, columns and frames</source>
        <translation>die Pixeldaten passen nicht zu Zeilen, Spalten und Frames</translation>
    </message>
    <message>
        <source>a lookup table is not as long as its descriptor states</source>
        <translation>eine Lookup-Tabelle ist nicht so lang, wie ihr Deskriptor sagt</translation>
    </message>
    <message>
        <source>the bits of its cells that are not stored cannot be cleared</source>
        <translation>die nicht gespeicherten Bits lassen sich nicht löschen</translation>
    </message>
    <message>
        <source>its RLE pixel data are damaged</source>
        <translation>ihre RLE-Pixeldaten sind beschädigt</translation>
    </message>
    <message>
        <source>its compression cannot be checked for text</source>
        <translation>ihre Kompression lässt sich nicht auf Text prüfen</translation>
    </message>
    <message>
        <source>its compressed frames cannot be told apart</source>
        <translation>ihre komprimierten Frames lassen sich nicht trennen</translation>
    </message>
    <message>
        <source>its compressed pixels have more bits than it states, which cannot be cleared</source>
        <translation>ihre komprimierten Pixel haben mehr Bits als genannt, die sich nicht löschen lassen</translation>
    </message>
    <message>
        <source>an icon: %~1</source>
        <translation>ein Icon: %~1</translation>
    </message>
    <message>
        <source>a DICOMDIR, which names patients</source>
        <translation>ein DICOMDIR, das Patienten nennt</translation>
    </message>
    <message>
        <source>of a private SOP class</source>
        <translation>von einer privaten SOP-Klasse</translation>
    </message>
    <message>
        <source>a structured document, whose text cannot be de-identified</source>
        <translation>ein strukturiertes Dokument, dessen Text sich nicht de-identifizieren lässt</translation>
    </message>
    <message>
        <source>an encapsulated document, whose text cannot be de-identified</source>
        <translation>ein eingebettetes Dokument, dessen Text sich nicht de-identifizieren lässt</translation>
    </message>
    <message>
        <source>a waveform, whose samples may identify</source>
        <translation>eine Kurve (EKG, Stimme), deren Werte den Patienten verraten können</translation>
    </message>
    <message>
        <source>raw data of a manufacturer, which may hold anything</source>
        <translation>Rohdaten eines Herstellers, die alles enthalten können</translation>
    </message>
    <message>
        <source>cannot be written</source>
        <translation>lässt sich nicht schreiben</translation>
    </message>
    <message>
        <source>the data dictionary of DCMTK is missing; install package libdcmtk17, and unset DCMDICTPATH</source>
        <translation>das Datenwörterbuch von DCMTK fehlt; installieren Sie das Paket libdcmtk17, und heben Sie DCMDICTPATH auf</translation>
    </message>
    <message>
        <source>is not DICOM, or damaged</source>
        <translation>ist kein DICOM, oder beschädigt</translation>
    </message>
    <message>
        <source>has burned-in annotation</source>
        <translation>hat eingebrannten Text</translation>
    </message>
    <message>
        <source>may have burned-in annotation</source>
        <translation>hat vielleicht eingebrannten Text</translation>
    </message>
    <message>
        <source>its contours or segments may be the skin of a face, which cannot be masked in them</source>
        <translation>ihre Konturen oder Segmente können die Haut eines Gesichts sein, das sich darin nicht maskieren lässt</translation>
    </message>
    <message>
        <source>its face cannot be masked: it is no slice of a CT or MR volume</source>
        <translation>ihr Gesicht lässt sich nicht maskieren: sie ist keine Schicht eines CT- oder MR-Volumens</translation>
    </message>
    <message>
        <source>removed: file meta information is written anew</source>
        <translation>entfernt: die Datei-Metainformation wird neu geschrieben</translation>
    </message>
    <message>
        <source>bits beside those stored cleared (overlays of old scanners)</source>
        <translation>Bits neben den gespeicherten gelöscht (Overlays alter Geräte)</translation>
    </message>
    <message>
        <source>bytes after the last pixel cleared</source>
        <translation>Bytes nach dem letzten Pixel gelöscht</translation>
    </message>
    <message>
        <source>comments, application segments and gaps of the compression cleared</source>
        <translation>Kommentare, Anwendungssegmente und Lücken der Kompression gelöscht</translation>
    </message>
    <message>
        <source>added without a value, as the standard requires the attribute</source>
        <translation>ohne Wert ergänzt, da der Standard das Attribut verlangt</translation>
    </message>
    <message>
        <source>its face cannot be masked: %1</source>
        <translation>ihr Gesicht lässt sich nicht maskieren: %1</translation>
    </message>
    <message>
        <source>its face cannot be masked: some of its frames are in no volume</source>
        <translation>ihr Gesicht lässt sich nicht maskieren: einige ihrer Frames gehören zu keinem Volumen</translation>
    </message>
    <message>
        <source>its face cannot be masked while its pixels are compressed: decompress it first</source>
        <translation>ihr Gesicht lässt sich nicht maskieren, solange die Pixel komprimiert sind: dekomprimieren Sie sie erst</translation>
    </message>
    <message>
        <source>its face cannot be masked: its pixels are of an unusual form</source>
        <translation>ihr Gesicht lässt sich nicht maskieren: die Pixel sind von ungewöhnlicher Form</translation>
    </message>
    <message>
        <source>the passphrase is too short: it needs at least 8 characters</source>
        <translation>die Passphrase ist zu kurz: sie braucht mindestens 8 Zeichen</translation>
    </message>
    <message>
        <source>%1: is in use by another program; try again when that has ended</source>
        <translation>%1: ist in einem anderen Programm offen; versuchen Sie es noch einmal, wenn es beendet ist</translation>
    </message>
    <message>
        <source>there is not enough memory to open the pseudonym map (Argon2id needs %#1 MiB)</source>
        <translation>der Speicher reicht nicht, um die Pseudonymtabelle zu öffnen (Argon2id braucht %#1 MiB)</translation>
    </message>
    <message>
        <source>is not a pseudonym map of Petrous, or damaged</source>
        <translation>ist keine Pseudonymtabelle von Petrous, oder beschädigt</translation>
    </message>
    <message>
        <source>was written by a newer version of Petrous</source>
        <translation>wurde mit einer neueren Version von Petrous geschrieben</translation>
    </message>
    <message>
        <source>is damaged or incomplete; restore it from a backup</source>
        <translation>ist beschädigt oder unvollständig; stellen Sie sie aus einer Sicherung wieder her</translation>
    </message>
    <message>
        <source>asks for an absurd amount of work; it was not written by Petrous</source>
        <translation>verlangt unsinnig viel Rechenarbeit; sie wurde nicht von Petrous geschrieben</translation>
    </message>
    <message>
        <source>cannot be opened with this passphrase</source>
        <translation>lässt sich mit dieser Passphrase nicht öffnen</translation>
    </message>
    <message>
        <source>holds no key</source>
        <translation>enthält keinen Schlüssel</translation>
    </message>
    <message>
        <source>is not a pseudonym map of this version</source>
        <translation>ist keine Pseudonymtabelle dieser Version</translation>
    </message>
    <message>
        <source>%1: is there already; give the copy a new name</source>
        <translation>%1: ist schon da; geben Sie der Kopie einen neuen Namen</translation>
    </message>
    <message>
        <source>%1: is not a regular file; remove it</source>
        <translation>%1: ist keine gewöhnliche Datei; entfernen Sie sie</translation>
    </message>
    <message>
        <source>the first %#1 s of a stroke that was being drilled</source>
        <translation>die ersten %#1 s eines Bohrzugs, der gerade lief</translation>
    </message>
    <message>
        <source>and the first %#1 s of a stroke that was being drilled</source>
        <translation>und die ersten %#1 s eines Bohrzugs, der gerade lief</translation>
    </message>
    <message>
        <source>the place in the history</source>
        <translation>die Stelle im Verlauf</translation>
    </message>
    <message>
        <source>%~1 (the end of its journal was not whole)</source>
        <translation>%~1 (das Ende des Journals war nicht vollständig)</translation>
    </message>
    <message>
        <source>case '%1'</source>
        <translation>Fall „%1“</translation>
    </message>
    <message>
        <source>%~1; it was set aside as %2</source>
        <translation>%~1; es wurde als %2 beiseitegelegt</translation>
    </message>
    <message>
        <source>written by format %#1; this program reads up to %#2</source>
        <translation>im Format %#1 geschrieben; dieses Programm liest bis %#2</translation>
    </message>
    <message>
        <source>the journal of a session that ended without saving cannot be read</source>
        <translation>das Journal einer Sitzung, die ohne Speichern endete, ist nicht lesbar</translation>
    </message>
    <message>
        <source>the journal of a session that ended without saving belongs to another state of the case</source>
        <translation>das Journal einer Sitzung, die ohne Speichern endete, gehört zu einem anderen Stand des Falls</translation>
    </message>
    <message>
        <source>the journal of a session that ended without saving does not fit (%~1)</source>
        <translation>das Journal einer Sitzung, die ohne Speichern endete, passt nicht (%~1)</translation>
    </message>
    <message>
        <source>the last session with case '%1' ended without saving; %~2 came back, on branch '%3', as another program had changed the case</source>
        <translation>die letzte Sitzung mit dem Fall „%1“ endete ohne Speichern; %~2 kam zurück, auf dem Zugang „%3“, da ein anderes Programm den Fall geändert hatte</translation>
    </message>
    <message>
        <source>the last session with case '%1' ended without saving; %~2 came back</source>
        <translation>die letzte Sitzung mit dem Fall „%1“ endete ohne Speichern; %~2 kam zurück</translation>
    </message>
    <message>
        <source>case '%1': %2 holds what a session drilled and did not save, and could not be brought back now: %~3; it stays there for the next time</source>
        <translation>Fall „%1“: %2 enthält, was eine Sitzung bohrte und nicht speicherte, und ließ sich jetzt nicht zurückholen: %~3; es bleibt dort für das nächste Mal</translation>
    </message>
    <message>
        <source>%1: is nothing that a case takes: a recording of the tool (.ticks), a PNG, a PDF, or a video (MP4, MOV, MKV, WebM, AVI, MPEG, WMV, FLV, Ogg)</source>
        <translation>%1: ist nichts, was ein Fall nimmt: eine Aufzeichnung des Werkzeugs (.ticks), ein PNG, ein PDF oder ein Video (MP4, MOV, MKV, WebM, AVI, MPEG, WMV, FLV, Ogg)</translation>
    </message>
    <message>
        <source>video</source>
        <translation>Video</translation>
    </message>
    <message>
        <source>%1: is larger than the %#2 MB that can be attached%~3</source>
        <translation>%1: ist größer als die %#2 MB, die sich anhängen lassen%~3</translation>
    </message>
    <message>
        <source>link it (--link)</source>
        <translation>hängen Sie es als Verknüpfung an</translation>
    </message>
    <message>
        <source>is none</source>
        <translation>ist keine</translation>
    </message>
    <message>
        <source>is damaged: a checksum is wrong</source>
        <translation>ist beschädigt: eine Prüfsumme stimmt nicht</translation>
    </message>
    <message>
        <source>is damaged: it does not begin with its header</source>
        <translation>ist beschädigt: sie beginnt nicht mit ihrem Header</translation>
    </message>
    <message>
        <source>is not whole</source>
        <translation>ist nicht vollständig</translation>
    </message>
    <message>
        <source>link it</source>
        <translation>hängen Sie es als Verknüpfung an</translation>
    </message>
    <message>
        <source>%1: %~2 is damaged: not what was stored there; remove it, or attach the same file again</source>
        <translation>%1: %~2 ist beschädigt: nicht das, was dort gespeichert wurde; entfernen Sie sie, oder hängen Sie dieselbe Datei noch einmal an</translation>
    </message>
    <message>
        <source>%~1; attachment '%2' cannot be stored: remove it, or put its file back</source>
        <translation>%~1; die Anlage „%2“ lässt sich nicht speichern: entfernen Sie sie, oder legen Sie ihre Datei zurück</translation>
    </message>
    <message>
        <source>attachment '%1'</source>
        <translation>Anlage „%1“</translation>
    </message>
    <message>
        <source>missing</source>
        <translation>fehlt</translation>
    </message>
    <message>
        <source>comparing with what was attached</source>
        <translation>Vergleich mit dem, was angehängt wurde</translation>
    </message>
    <message>
        <source>%~1 is not saved yet</source>
        <translation>%~1 ist noch nicht gespeichert</translation>
    </message>
    <message>
        <source>the linked file is another one than was attached; put the former one back, or remove the attachment and attach this one</source>
        <translation>die verknüpfte Datei ist eine andere als die angehängte; legen Sie die frühere zurück, oder entfernen Sie die Anlage, und hängen Sie diese an</translation>
    </message>
    <message>
        <source>is damaged: not what was stored there; restore it from a copy of the library, or remove the attachment</source>
        <translation>ist beschädigt: nicht das, was dort gespeichert wurde; stellen Sie sie aus einer Kopie der Bibliothek wieder her, oder entfernen Sie die Anlage</translation>
    </message>
    <message>
        <source>%~1; it belongs to attachment '%2' of case '%3'</source>
        <translation>%~1; sie gehört zur Anlage „%2“ des Falls „%3“</translation>
    </message>
    <message>
        <source>%1: does not name the library's folder; write its path there, or remove the file to use the usual one</source>
        <translation>%1: nennt nicht den Ordner der Bibliothek; schreiben Sie dessen Pfad hinein, oder entfernen Sie die Datei, um den üblichen zu nehmen</translation>
    </message>
    <message>
        <source>%1: the library's folder is not there; connect its disk, or choose another folder (petrous library folder DIR)</source>
        <translation>%1: der Ordner der Bibliothek ist nicht da; schließen Sie den Datenträger an, oder wählen Sie einen anderen Ordner (petrous library folder DIR)</translation>
    </message>
    <message>
        <source>no home folder to keep the choice in; give --library DIR instead</source>
        <translation>es gibt keinen persönlichen Ordner für die Wahl; starten Sie stattdessen mit --library ORDNER</translation>
    </message>
    <message>
        <source>%1: a library's path must be one line</source>
        <translation>%1: der Pfad einer Bibliothek muss eine Zeile sein</translation>
    </message>
    <message>
        <source>%1: a library keeps its own data there; choose that library's folder, or one outside of it</source>
        <translation>%1: dort hat eine Bibliothek ihre eigenen Daten; wählen Sie deren Ordner, oder einen außerhalb</translation>
    </message>
    <message>
        <source>the library's folder is as it was</source>
        <translation>der Ordner der Bibliothek ist, wie er war</translation>
    </message>
    <message>
        <source>%1: a case was made from this file, which would be replaced; name another file</source>
        <translation>%1: aus dieser Datei wurde ein Fall erstellt, sie würde ersetzt; geben Sie eine andere Datei an</translation>
    </message>
    <message>
        <source>%1: is a file; a library is a folder: give one, or a new name</source>
        <translation>%1: ist eine Datei; eine Bibliothek ist ein Ordner: geben Sie einen Ordner oder einen neuen Namen an</translation>
    </message>
    <message>
        <source>%1: no library can be there, as %2 is a file; give a folder</source>
        <translation>%1: dort kann keine Bibliothek sein, da %2 eine Datei ist; geben Sie einen Ordner an</translation>
    </message>
    <message>
        <source>%1: no library can be there, as %2 is not there; is the path right, and its disk mounted? For a new library make that folder first</source>
        <translation>%1: dort kann keine Bibliothek sein, da %2 nicht da ist; stimmt der Pfad, und ist der Datenträger eingehängt? Legen Sie für eine neue Bibliothek zuerst diesen Ordner an</translation>
    </message>
    <message>
        <source>%1: a file stands where the library needs a folder; choose another library folder</source>
        <translation>%1: wo die Bibliothek einen Ordner braucht, steht eine Datei; wählen Sie einen anderen Ordner für die Bibliothek</translation>
    </message>
    <message>
        <source>another program is using the library</source>
        <translation>ein anderes Programm verwendet die Bibliothek</translation>
    </message>
    <message>
        <source>checking the voxels</source>
        <translation>Voxel werden geprüft</translation>
    </message>
    <message>
        <source>restore this file from a copy of the library, take it up again from its own file (petrous view --instrument), or take it out of the case (--clear instrument); 'petrous library verify' lists all that is damaged</source>
        <translation>stellen Sie diese Datei aus einer Kopie der Bibliothek wieder her, nehmen Sie es aus seiner eigenen Datei wieder auf (petrous view --instrument), oder nehmen Sie es aus dem Fall (--clear instrument); „petrous library verify“ nennt alles, was beschädigt ist</translation>
    </message>
    <message>
        <source>restore this file from a copy of the library; 'petrous library verify' lists all that is damaged</source>
        <translation>stellen Sie diese Datei aus einer Kopie der Bibliothek wieder her</translation>
    </message>
    <message>
        <source>restore this file from a copy of the library, or import the same data again (into a new case), which puts it back; 'petrous library verify' lists all that is damaged</source>
        <translation>stellen Sie diese Datei aus einer Kopie der Bibliothek wieder her, oder importieren Sie dieselben Daten noch einmal (in einen neuen Fall), was sie zurückbringt</translation>
    </message>
    <message>
        <source>restore this file from a copy of the library, or attach the same file again, which puts it back; 'petrous library verify' lists all that is damaged</source>
        <translation>stellen Sie diese Datei aus einer Kopie der Bibliothek wieder her, oder hängen Sie dieselbe Datei noch einmal an, was sie zurückbringt</translation>
    </message>
    <message>
        <source>%1: this file is damaged: not what was stored there%~2</source>
        <translation>%1: diese Datei ist beschädigt: nicht das, was dort gespeichert wurde%~2</translation>
    </message>
    <message>
        <source>%1: %~2 is damaged: not what was stored there%~3</source>
        <translation>%1: %~2 ist beschädigt: nicht das, was dort gespeichert wurde%~3</translation>
    </message>
    <message>
        <source>%1: missing%~2</source>
        <translation>%1: fehlt%~2</translation>
    </message>
    <message>
        <source>%1: %~2 is missing%~3</source>
        <translation>%1: %~2 fehlt%~3</translation>
    </message>
    <message>
        <source>checking a file</source>
        <translation>Datei wird geprüft</translation>
    </message>
    <message>
        <source>%1: the disk does not confirm what was written; check the disk</source>
        <translation>%1: der Datenträger bestätigt nicht, was geschrieben wurde; prüfen Sie ihn</translation>
    </message>
    <message>
        <source>%1: the case refers to an object by an invalid name; restore its manifest from a copy of the library</source>
        <translation>%1: der Fall nennt ein Objekt mit ungültigem Namen; stellen Sie sein Manifest aus einer Kopie der Bibliothek wieder her</translation>
    </message>
    <message>
        <source>%1: cannot be read; check the permissions</source>
        <translation>%1: lässt sich nicht lesen; prüfen Sie die Rechte</translation>
    </message>
    <message>
        <source>process %#1 on '%2'</source>
        <translation>Prozess %#1 auf „%2“</translation>
    </message>
    <message>
        <source>%1: cannot be created; is the disk full, or TMPDIR wrong?</source>
        <translation>%1: lässt sich nicht anlegen; ist der Datenträger voll oder TMPDIR falsch?</translation>
    </message>
    <message>
        <source>%1: folders that are made there are gone at once; is TMPDIR right?</source>
        <translation>%1: dort angelegte Ordner sind sofort wieder weg; stimmt TMPDIR?</translation>
    </message>
    <message>
        <source>copying a file</source>
        <translation>Datei wird kopiert</translation>
    </message>
    <message>
        <source>the thumbnail is as it was</source>
        <translation>das Vorschaubild ist, wie es war</translation>
    </message>
    <message>
        <source>thumbnail: must be a PNG of %#1 x %#2 pixels, RGB, without metadata</source>
        <translation>Vorschaubild: muss ein PNG von %#1 x %#2 Pixeln sein, RGB, ohne Metadaten</translation>
    </message>
    <message>
        <source>case '%1' is of a first version of this program and has no id, by which a thumbnail goes; a copy of it has ('petrous library copy')</source>
        <translation>der Fall „%1“ ist aus einer ersten Version dieses Programms und hat keine Kennung, nach der ein Vorschaubild geht; eine Kopie von ihm hat eine (Kopieren in der Bibliothek)</translation>
    </message>
</context>
<context>
    <name>Network</name>
    <message>
        <source>%1: what it answers is not valid DICOM (%~2); the connection was ended; is it a DICOM node?</source>
        <translation>%1: Was er antwortet, ist kein gültiges DICOM (%~2); die Verbindung wurde beendet; ist es ein DICOM-Knoten?</translation>
    </message>
    <message>
        <source>node '%1': %~2</source>
        <translation>Knoten „%1“: %~2</translation>
    </message>
    <message>
        <source>%1: is not there; give a PEM file</source>
        <translation>%1: ist nicht da; nennen Sie eine PEM-Datei</translation>
    </message>
    <message>
        <source>TLS 1.2 is not available here</source>
        <translation>TLS 1.2 ist hier nicht verfügbar</translation>
    </message>
    <message>
        <source>%1: is not a PEM file of certificates to trust</source>
        <translation>%1: ist keine PEM-Datei mit vertrauten Zertifikaten</translation>
    </message>
    <message>
        <source>%1: is not a PEM file of a private key without a passphrase</source>
        <translation>%1: ist keine PEM-Datei mit einem privaten Schlüssel ohne Passphrase</translation>
    </message>
    <message>
        <source>%1: is not a PEM file of a certificate of at least 2048 bits</source>
        <translation>%1: ist keine PEM-Datei mit einem Zertifikat von mindestens 2048 Bit</translation>
    </message>
    <message>
        <source>%1: is not the key of %2</source>
        <translation>%1: ist nicht der Schlüssel von %2</translation>
    </message>
    <message>
        <source>node '%1': '%2' cannot be compared with its certificate; give the name in its certificate (--tls-name)</source>
        <translation>Knoten „%1“: „%2“ lässt sich nicht mit seinem Zertifikat vergleichen; geben Sie den Namen in seinem Zertifikat an (Bibliothek &gt; DICOM-Knoten)</translation>
    </message>
    <message>
        <source>the system's trusted certificates cannot be read; give a file of certificates</source>
        <translation>die vertrauten Zertifikate des Systems sind nicht lesbar; nennen Sie eine Datei mit Zertifikaten</translation>
    </message>
    <message>
        <source>%1: refuses the association</source>
        <translation>%1: lehnt die Verbindung ab</translation>
    </message>
    <message>
        <source>%~1, as it does not know '%2'; have that AE title added there</source>
        <translation>%~1, da er „%2“ nicht kennt; lassen Sie diesen AE-Titel dort eintragen</translation>
    </message>
    <message>
        <source>%~1, as it is not called '%2'; correct the AE title</source>
        <translation>%~1, da er nicht „%2“ heißt; berichtigen Sie den AE-Titel</translation>
    </message>
    <message>
        <source>%~1, as it is busy; try again later</source>
        <translation>%~1, da er beschäftigt ist; versuchen Sie es später</translation>
    </message>
    <message>
        <source>%~1; ask its administrator whether this program may call it</source>
        <translation>%~1; fragen Sie seine Administration, ob dieses Programm ihn rufen darf</translation>
    </message>
    <message>
        <source>its certificate is not of '%1'; if it is the right node, give the name in its certificate (--tls-name)</source>
        <translation>sein Zertifikat ist nicht das von „%1“; ist es der richtige Knoten, geben Sie den Namen in seinem Zertifikat an (Bibliothek &gt; DICOM-Knoten)</translation>
    </message>
    <message>
        <source>its certificate, or its authority's, has expired or is not valid yet; have it renewed, or set the clock of this computer</source>
        <translation>sein Zertifikat oder das seiner Zertifizierungsstelle ist abgelaufen oder noch nicht gültig; lassen Sie es erneuern, oder stellen Sie die Uhr dieses Rechners</translation>
    </message>
    <message>
        <source>its certificate is not of a trusted authority</source>
        <translation>sein Zertifikat ist von keiner vertrauten Zertifizierungsstelle</translation>
    </message>
    <message>
        <source>it wants a certificate of this program</source>
        <translation>er verlangt ein Zertifikat dieses Programms</translation>
    </message>
    <message>
        <source>it refuses the certificate of this program</source>
        <translation>er lehnt das Zertifikat dieses Programms ab</translation>
    </message>
    <message>
        <source>%~1, or does not speak TLS 1.2 or later with a permitted cipher (BCP 195)</source>
        <translation>%~1, oder spricht kein TLS ab 1.2 mit erlaubter Chiffre (BCP 195)</translation>
    </message>
    <message>
        <source>it does not speak TLS 1.2 or later with a permitted cipher (BCP 195)</source>
        <translation>er spricht kein TLS ab 1.2 mit erlaubter Chiffre (BCP 195)</translation>
    </message>
    <message>
        <source>node '%1' (%2:%#3)</source>
        <translation>Knoten „%1“ (%2:%#3)</translation>
    </message>
    <message>
        <source>%1: sends an instance of more than 4 GB; %2 was ended</source>
        <translation>%1: sendet eine Instanz von mehr als 4 GB; %2 wurde beendet</translation>
    </message>
    <message>
        <source>%1: what it answers is not valid DICOM; %2 was ended</source>
        <translation>%1: die Antwort ist kein gültiges DICOM; %2 wurde beendet</translation>
    </message>
    <message>
        <source>%1: nothing answers there; check host, port, network and firewall</source>
        <translation>%1: dort antwortet nichts; prüfen Sie Rechner, Port, Netz und Firewall</translation>
    </message>
    <message>
        <source>%1: has not answered for %#2 s; %3 was ended</source>
        <translation>%1: antwortet seit %#2 s nicht; %3 wurde beendet</translation>
    </message>
    <message>
        <source>%1: has not answered for %#2 s; %3 was ended; is it a DICOM node, and not too busy?</source>
        <translation>%1: antwortet seit %#2 s nicht; %3 wurde beendet; ist es ein DICOM-Knoten, und nicht zu beschäftigt?</translation>
    </message>
    <message>
        <source>%1: the connection was lost during %2</source>
        <translation>%1: die Verbindung brach ab bei: %2</translation>
    </message>
    <message>
        <source>%1: the connection was lost during %2; does it expect TLS, and the certificate of this program?</source>
        <translation>%1: die Verbindung brach ab bei: %2; erwartet er TLS und das Zertifikat dieses Programms?</translation>
    </message>
    <message>
        <source>%1: the connection was lost during %2; does it expect TLS?</source>
        <translation>%1: die Verbindung brach ab bei: %2; erwartet er TLS?</translation>
    </message>
    <message>
        <source>%1: no secure connection; %2</source>
        <translation>%1: keine sichere Verbindung; %2</translation>
    </message>
    <message>
        <source>%1: accepts nothing of what was asked for; it is not a node for this purpose</source>
        <translation>%1: nimmt nichts vom Verlangten an; er ist kein Knoten für diesen Zweck</translation>
    </message>
    <message>
        <source>network: too many files are open; close other cases, or raise the limit (ulimit -n)</source>
        <translation>Netz: zu viele Dateien sind offen; schließen Sie andere Fälle, oder erhöhen Sie die Grenze (ulimit -n)</translation>
    </message>
    <message>
        <source>(status %1)</source>
        <translation>(Status %1)</translation>
    </message>
    <message>
        <source>it is out of resources%~1</source>
        <translation>seine Mittel sind erschöpft%~1</translation>
    </message>
    <message>
        <source>the request does not match its model, or it refuses the object%~1</source>
        <translation>die Anfrage passt nicht zu ihrem Modell, oder er lehnt das Objekt ab%~1</translation>
    </message>
    <message>
        <source>it does not know this program's AE title as a destination; have it added there%~1</source>
        <translation>er kennt den AE-Titel dieses Programms nicht als Ziel; lassen Sie ihn dort eintragen%~1</translation>
    </message>
    <message>
        <source>it does not support this kind of object%~1</source>
        <translation>er unterstützt diese Art von Objekt nicht%~1</translation>
    </message>
    <message>
        <source>this program may not do that there%~1</source>
        <translation>dieses Programm darf das dort nicht%~1</translation>
    </message>
    <message>
        <source>it cancelled the request%~1</source>
        <translation>er brach die Anfrage ab%~1</translation>
    </message>
    <message>
        <source>it cannot process the request%~1</source>
        <translation>er kann die Anfrage nicht bearbeiten%~1</translation>
    </message>
    <message>
        <source>%1: answers a query more than %#2 times; narrow the search</source>
        <translation>%1: beantwortet eine Abfrage mehr als %#2-mal; engen Sie die Suche ein</translation>
    </message>
    <message>
        <source>the query</source>
        <translation>die Abfrage</translation>
    </message>
    <message>
        <source>%1: does not offer queries (C-FIND, study root)</source>
        <translation>%1: bietet keine Abfragen (C-FIND, Study Root)</translation>
    </message>
    <message>
        <source>%1: refuses the query: %~2</source>
        <translation>%1: lehnt die Abfrage ab: %~2</translation>
    </message>
    <message>
        <source>%1: is not a DICOM file that can be sent</source>
        <translation>%1: ist keine DICOM-Datei, die sich senden lässt</translation>
    </message>
    <message>
        <source>DICOM: too many kinds of objects for one transfer; send fewer</source>
        <translation>DICOM: zu viele Arten von Objekten für eine Übertragung; senden Sie weniger</translation>
    </message>
    <message>
        <source>sending, %#1 of %#2</source>
        <translation>Senden, %#1 von %#2</translation>
    </message>
    <message>
        <source>receiving, %#1 of %#2</source>
        <translation>Empfangen, %#1 von %#2</translation>
    </message>
    <message>
        <source>%1: cannot be read any more</source>
        <translation>%1: ist nicht mehr lesbar</translation>
    </message>
    <message>
        <source>bringing to the disk</source>
        <translation>Schreiben auf den Datenträger</translation>
    </message>
    <message>
        <source>%1: sent an instance of another patient, study or series than was asked for; the transfer was ended</source>
        <translation>%1: sandte eine Instanz eines anderen Patienten, einer anderen Studie oder Serie als verlangt; die Übertragung wurde beendet</translation>
    </message>
    <message>
        <source>%1: sends more instances than it was asked for, without end; the transfer was ended</source>
        <translation>%1: sendet endlos mehr Instanzen als verlangt; die Übertragung wurde beendet</translation>
    </message>
    <message>
        <source>%1: C-MOVE with TLS needs the certificates to trust: those of the system would let anyone send; see 'petrous nodes add --tls-ca'</source>
        <translation>%1: C-MOVE mit TLS braucht die vertrauten Zertifikate: Mit denen des Systems dürfte jeder senden; siehe Bibliothek &gt; DICOM-Knoten</translation>
    </message>
    <message>
        <source>%1: C-MOVE with TLS needs a certificate of this program; see 'petrous nodes add --tls-cert'</source>
        <translation>%1: C-MOVE mit TLS braucht ein Zertifikat dieses Programms; siehe Bibliothek &gt; DICOM-Knoten</translation>
    </message>
    <message>
        <source>%1: this program cannot listen at port %#2 for C-MOVE; is it in use, or below 1024?</source>
        <translation>%1: dieses Programm kann am Port %#2 nicht auf C-MOVE warten; ist er belegt oder unter 1024?</translation>
    </message>
    <message>
        <source>%1: nothing was received by C-MOVE: %~2</source>
        <translation>%1: durch C-MOVE kam nichts an: %~2</translation>
    </message>
    <message>
        <source>a connection of another host was refused; if the node sends from another one, change it in the node (--move-host)</source>
        <translation>die Verbindung eines anderen Rechners wurde abgelehnt; sendet der Knoten von einem anderen, ändern Sie es beim Knoten (Bibliothek &gt; DICOM-Knoten)</translation>
    </message>
    <message>
        <source>what connected does not call itself '%1'</source>
        <translation>was sich verband, nennt sich nicht „%1“</translation>
    </message>
    <message>
        <source>%1: offers retrieval by C-MOVE only; add it with --move-port, and have this program's AE title, host and port added there</source>
        <translation>%1: bietet Abruf nur durch C-MOVE; geben Sie ihm einen Port dafür (Bibliothek &gt; DICOM-Knoten), und lassen Sie dort AE-Titel, Rechner und Port dieses Programms eintragen</translation>
    </message>
    <message>
        <source>%1: offers no retrieval (C-GET or C-MOVE)</source>
        <translation>%1: bietet keinen Abruf (C-GET oder C-MOVE)</translation>
    </message>
    <message>
        <source>%1: ended the retrieval, %#2 of %~3 arrived: %~4</source>
        <translation>%1: beendete den Abruf, %#2 von %~3 kamen an: %~4</translation>
    </message>
    <message>
        <source>waiting for the node's list</source>
        <translation>auf die Liste des Knotens wird gewartet</translation>
    </message>
    <message>
        <source>DICOM node '%1': %~2</source>
        <translation>DICOM-Knoten „%1“: %~2</translation>
    </message>
    <message>
        <source>DICOM node '?': %~1</source>
        <translation>DICOM-Knoten „?“: %~1</translation>
    </message>
    <message>
        <source>DICOM node: give it a name</source>
        <translation>DICOM-Knoten: geben Sie ihm einen Namen</translation>
    </message>
    <message>
        <source>its name is UTF-8 text without control characters</source>
        <translation>sein Name ist Text in UTF-8 ohne Steuerzeichen</translation>
    </message>
    <message>
        <source>the host is a name or an IPv4 address, without a port</source>
        <translation>der Rechner ist ein Name oder eine IPv4-Adresse, ohne Port</translation>
    </message>
    <message>
        <source>the host that sends by C-MOVE is a name or an IPv4 address, without a port, or %1 for any</source>
        <translation>der Rechner, der durch C-MOVE sendet, ist ein Name oder eine IPv4-Adresse, ohne Port, oder %1 für jeden</translation>
    </message>
    <message>
        <source>the port is between 1 and 65535</source>
        <translation>der Port liegt zwischen 1 und 65535</translation>
    </message>
    <message>
        <source>the port for C-MOVE is between 1 and 65535, or 0</source>
        <translation>der Port für C-MOVE liegt zwischen 1 und 65535, oder ist 0</translation>
    </message>
    <message>
        <source>an AE title has 1 to 16 ASCII characters</source>
        <translation>ein AE-Titel hat 1 bis 16 ASCII-Zeichen</translation>
    </message>
    <message>
        <source>a TLS certificate and its key are given together</source>
        <translation>ein TLS-Zertifikat und sein Schlüssel werden zusammen angegeben</translation>
    </message>
    <message>
        <source>the paths of TLS files are UTF-8 text without control characters</source>
        <translation>die Pfade von TLS-Dateien sind Text in UTF-8 ohne Steuerzeichen</translation>
    </message>
    <message>
        <source>the name in its certificate is a host name or an IP address</source>
        <translation>der Name in seinem Zertifikat ist ein Rechnername oder eine IP-Adresse</translation>
    </message>
    <message>
        <source>certificates of any name are for trusted certificates of your own only; of the system's authorities everybody can have one</source>
        <translation>Zertifikate auf beliebige Namen gibt es nur mit eigenen vertrauten Zertifikaten; von den Zertifizierungsstellen des Systems kann jeder eines haben</translation>
    </message>
    <message>
        <source>%1: C-ECHO failed: %~2</source>
        <translation>%1: C-ECHO misslang: %~2</translation>
    </message>
    <message>
        <source>%1: has the SOP Instance UID of another file</source>
        <translation>%1: hat die SOP Instance UID einer anderen Datei</translation>
    </message>
    <message>
        <source>%~1; %#2 of %~3 were confirmed</source>
        <translation>%~1; %#2 von %~3 wurden bestätigt</translation>
    </message>
    <message>
        <source>%1: has %#2 of %~3 after %#4 attempts: %~5</source>
        <translation>%1: hat %#2 von %~3 nach %#4 Versuchen: %~5</translation>
    </message>
    <message>
        <source>%1: has %#2 of %~3 after %#4 attempts, although it confirmed them</source>
        <translation>%1: hat %#2 von %~3 nach %#4 Versuchen, obwohl er sie bestätigte</translation>
    </message>
    <message>
        <source>%1: cannot be created</source>
        <translation>%1: lässt sich nicht anlegen</translation>
    </message>
    <message>
        <source>%1: has no such study</source>
        <translation>%1: hat keine solche Studie</translation>
    </message>
    <message>
        <source>%1: does not have %#2 of the series that were asked for</source>
        <translation>%1: hat %#2 der verlangten Serien nicht</translation>
    </message>
    <message>
        <source>%1: has no instances of that study</source>
        <translation>%1: hat keine Instanzen dieser Studie</translation>
    </message>
    <message>
        <source>%1: states %~2 of what was asked for, but lists %#3; it may still be receiving them, try again later</source>
        <translation>%1: nennt %~2 des Verlangten, führt aber %#3 auf; vielleicht empfängt er sie noch, versuchen Sie es später</translation>
    </message>
    <message>
        <source>%~1; %#2 of %~3 arrived</source>
        <translation>%~1; %#2 von %~3 kamen an</translation>
    </message>
    <message>
        <source>%1: sent %#2 of %~3; the rest was asked for %#4 times</source>
        <translation>%1: sandte %#2 von %~3; der Rest wurde %#4-mal verlangt</translation>
    </message>
    <message>
        <source>%1: is not a list of DICOM nodes; remove it and add them again</source>
        <translation>%1: ist keine Liste von DICOM-Knoten; entfernen Sie sie, und fügen Sie die Knoten neu hinzu</translation>
    </message>
    <message>
        <source>%1: written by format %#2; this program reads up to %#3</source>
        <translation>%1: im Format %#2 geschrieben; dieses Programm liest bis %#3</translation>
    </message>
    <message>
        <source>no DICOM node '%1'; there is none, see 'petrous nodes add'</source>
        <translation>kein DICOM-Knoten „%1“; es gibt keinen, siehe Bibliothek &gt; DICOM-Knoten</translation>
    </message>
    <message>
        <source>no DICOM node '%1'; there are: %2</source>
        <translation>kein DICOM-Knoten „%1“; es gibt: %2</translation>
    </message>
    <message>
        <source>no DICOM node '?'; there is none, see 'petrous nodes add'</source>
        <translation>kein DICOM-Knoten „?“; es gibt keinen, siehe Bibliothek &gt; DICOM-Knoten</translation>
    </message>
    <message>
        <source>no DICOM node '?'; there are: %1</source>
        <translation>kein DICOM-Knoten „?“; es gibt: %1</translation>
    </message>
    <message>
        <source>a DICOM node '%1' is there already; remove it first, or choose another name</source>
        <translation>ein DICOM-Knoten „%1“ ist schon da; entfernen Sie ihn erst, oder wählen Sie einen anderen Namen</translation>
    </message>
    <message>
        <source>a data value of %#1 bytes</source>
        <translation>ein Datenwert von %#1 Bytes</translation>
    </message>
    <message>
        <source>a PDU of type %#1 with a part that is longer than it is</source>
        <translation>eine PDU des Typs %#1 mit einem Teil, der länger ist als sie</translation>
    </message>
    <message>
        <source>a PDU of type %#1 with bytes behind its last part</source>
        <translation>eine PDU des Typs %#1 mit Bytes hinter ihrem letzten Teil</translation>
    </message>
    <message>
        <source>a PDU of type %#1</source>
        <translation>eine PDU des Typs %#1</translation>
    </message>
    <message>
        <source>a PDU of type %#1 that states %#2 bytes</source>
        <translation>eine PDU des Typs %#1, die %#2 Bytes angibt</translation>
    </message>
    <message>
        <source>the scene's DICOM objects: %~1; have it sent again</source>
        <translation>die DICOM-Objekte der Szene: %~1; lassen Sie sie noch einmal senden</translation>
    </message>
    <message>
        <source>reading the scene</source>
        <translation>die Szene wird gelesen</translation>
    </message>
    <message>
        <source>one is not a DICOM file</source>
        <translation>eines ist keine DICOM-Datei</translation>
    </message>
    <message>
        <source>one is not a part of a Petrous scene, or the server did not keep its data</source>
        <translation>eines ist kein Teil einer Szene von Petrous, oder der Server behielt seine Daten nicht</translation>
    </message>
    <message>
        <source>the scene's DICOM objects are of format %#1; this program reads up to %#2</source>
        <translation>die DICOM-Objekte der Szene sind im Format %#1; dieses Programm liest bis %#2</translation>
    </message>
    <message>
        <source>one has a damaged head</source>
        <translation>eines hat einen beschädigten Kopf</translation>
    </message>
    <message>
        <source>the scene's DICOM objects: need a study, and parts of 1 byte to 1 GB</source>
        <translation>die DICOM-Objekte der Szene: brauchen eine Studie und Teile von 1 Byte bis 1 GB</translation>
    </message>
    <message>
        <source>writing the scene</source>
        <translation>die Szene wird geschrieben</translation>
    </message>
    <message>
        <source>the scene's DICOM objects cannot be built</source>
        <translation>die DICOM-Objekte der Szene lassen sich nicht erstellen</translation>
    </message>
    <message>
        <source>%#1 of %#2 parts are there, or they are not of one scene</source>
        <translation>%#1 von %#2 Teilen sind da, oder sie sind nicht aus einer Szene</translation>
    </message>
    <message>
        <source>parts are missing</source>
        <translation>Teile fehlen</translation>
    </message>
    <message>
        <source>one changed while it was read</source>
        <translation>eines änderte sich beim Lesen</translation>
    </message>
    <message>
        <source>their content is damaged (SHA-256)</source>
        <translation>ihr Inhalt ist beschädigt (SHA-256)</translation>
    </message>
</context>
<context>
    <name>Registration</name>
    <message>
        <source>registration: the %1 has one slice alone; a rigid fit needs a volume</source>
        <translation>Registrierung: das %1 hat nur eine Schicht; eine starre Anpassung braucht ein Volumen</translation>
    </message>
    <message>
        <source>registration: the %1 holds next to no voxels with a value</source>
        <translation>Registrierung: das %1 enthält fast keine Voxel mit einem Wert</translation>
    </message>
    <message>
        <source>registration: the %1 is the same everywhere; there is nothing to align</source>
        <translation>Registrierung: das %1 ist überall gleich; es gibt nichts auszurichten</translation>
    </message>
    <message>
        <source>registration: the region lies outside the CT</source>
        <translation>Registrierung: der Bereich liegt außerhalb des CT</translation>
    </message>
    <message>
        <source>good</source>
        <translation>gut</translation>
    </message>
    <message>
        <source>doubtful</source>
        <translation>zweifelhaft</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>misslungen</translation>
    </message>
    <message>
        <source>the images share too little: %#1 of the smaller one's field</source>
        <translation>die Bilder haben zu wenig gemeinsam: %#1 vom Feld des kleineren</translation>
    </message>
    <message>
        <source>the images tell next to nothing about each other (%#1 nats)</source>
        <translation>die Bilder sagen fast nichts übereinander aus (%#1 nat)</translation>
    </message>
    <message>
        <source>%#1 of the repeated fits ended elsewhere</source>
        <translation>%#1 der wiederholten Anpassungen endeten anderswo</translation>
    </message>
    <message>
        <source>the point lies outside one of the images: its error is extrapolated</source>
        <translation>der Punkt liegt außerhalb eines der Bilder: sein Fehler ist extrapoliert</translation>
    </message>
    <message>
        <source>the moving image mirrored left to right fits as well (%#1 times the score): wrong side, or a header with the sides exchanged?</source>
        <translation>das bewegte Bild passt, links und rechts gespiegelt, ebenso gut (%#1-faches Maß): falsche Seite, oder ein Header mit vertauschten Seiten?</translation>
    </message>
    <message>
        <source>another pose fits nearly as well (%#1 times the score)</source>
        <translation>eine andere Lage passt fast ebenso gut (%#1-faches Maß)</translation>
    </message>
    <message>
        <source>the error may reach %#1 mm</source>
        <translation>der Fehler kann %#1 mm erreichen</translation>
    </message>
    <message>
        <source>what lies within %#1 mm of the point fits %#2 mm beside the rest: it is displaced or the images are distorted there, and the error counts from where it lies</source>
        <translation>was innerhalb von %#1 mm um den Punkt liegt, passt %#2 mm neben dem Rest: Es ist verschoben, oder die Bilder sind dort verzerrt, und der Fehler zählt von dort, wo es liegt</translation>
    </message>
    <message>
        <source>what lies about the point alone fits %#1 mm beside: the images differ by more than a rigid motion</source>
        <translation>was um den Punkt liegt, passt allein %#1 mm daneben: Die Bilder unterscheiden sich um mehr als eine starre Bewegung</translation>
    </message>
    <message>
        <source>the fit ended %#1 mm from where it began: %~2</source>
        <translation>die Anpassung endete %#1 mm von ihrem Anfang: %~2</translation>
    </message>
    <message>
        <source>repeated fits agree; 95 of 100 errors are below %#1 mm</source>
        <translation>wiederholte Anpassungen stimmen überein; 95 von 100 Fehlern liegen unter %#1 mm</translation>
    </message>
    <message>
        <source>coarse search</source>
        <translation>Grobsuche</translation>
    </message>
    <message>
        <source>landmarks: %#1 pair; a rigid fit needs three</source>
        <translation>Landmarken: %#1 Paar; eine starre Anpassung braucht drei</translation>
    </message>
    <message>
        <source>landmarks: %#1 pairs; a rigid fit needs three</source>
        <translation>Landmarken: %#1 Paare; eine starre Anpassung braucht drei</translation>
    </message>
    <message>
        <source>landmarks: pair %#1 has a coordinate that is not a number</source>
        <translation>Landmarken: Paar %#1 hat eine Koordinate, die keine Zahl ist</translation>
    </message>
    <message>
        <source>landmarks: the points lie on one line within 1 mm; add one that does not</source>
        <translation>Landmarken: die Punkte liegen auf 1 mm genau auf einer Linie; fügen Sie einen hinzu, der es nicht tut</translation>
    </message>
    <message>
        <source>still: %#1 landmarks; four are needed</source>
        <translation>Standbild: %#1 Landmarken; vier sind nötig</translation>
    </message>
    <message>
        <source>still: %#1 landmarks; six are needed to find the angle of view too, four if it is given</source>
        <translation>Standbild: %#1 Landmarken; sechs sind nötig, um auch den Bildwinkel zu finden, vier, wenn er gegeben ist</translation>
    </message>
    <message>
        <source>still: it has no pixels</source>
        <translation>Standbild: es hat keine Pixel</translation>
    </message>
    <message>
        <source>still: the angle of view must lie within 0.5 to 120 degrees</source>
        <translation>Standbild: der Bildwinkel muss in 0.5 bis 120 Grad liegen</translation>
    </message>
    <message>
        <source>still: landmark %#1 has a coordinate that is not a number</source>
        <translation>Standbild: Landmarke %#1 hat eine Koordinate, die keine Zahl ist</translation>
    </message>
    <message>
        <source>still: the landmarks lie on one line within 1 mm; add one that does not</source>
        <translation>Standbild: die Landmarken liegen auf 1 mm genau auf einer Linie; fügen Sie eine hinzu, die es nicht tut</translation>
    </message>
    <message>
        <source>still: no camera sees the landmarks so; is one of them mistaken for another?</source>
        <translation>Standbild: keine Kamera sieht die Landmarken so; ist eine mit einer anderen verwechselt?</translation>
    </message>
    <message>
        <source>still: the landmarks do not tell the angle of view; give it, or set landmarks of more different depth</source>
        <translation>Standbild: die Landmarken ergeben den Bildwinkel nicht; geben Sie ihn an, oder setzen Sie Landmarken in verschiedeneren Tiefen</translation>
    </message>
</context>
<context>
    <name>Rendering</name>
    <message>
        <source>cannot draw without a display: %~1; OpenGL 3.2 through EGL is needed (Debian: apt install libegl1 libgl1-mesa-dri)</source>
        <translation>ohne Bildschirm lässt sich nicht zeichnen: %~1; nötig ist OpenGL 3.2 über EGL (Debian: apt install libegl1 libgl1-mesa-dri)</translation>
    </message>
    <message>
        <source>libEGL.so.1 is not installed</source>
        <translation>libEGL.so.1 ist nicht installiert</translation>
    </message>
    <message>
        <source>libEGL.so.1 has no %1</source>
        <translation>libEGL.so.1 hat kein %1</translation>
    </message>
    <message>
        <source>no EGL device or surfaceless platform gives a context</source>
        <translation>kein EGL-Gerät und keine Plattform ohne Oberfläche gibt einen Kontext</translation>
    </message>
    <message>
        <source>the OpenGL context was lost</source>
        <translation>der OpenGL-Kontext ging verloren</translation>
    </message>
    <message>
        <source>cannot draw without a display: the driver offers less than OpenGL 3.2 (Debian: apt install libegl1 libgl1-mesa-dri)</source>
        <translation>ohne Bildschirm lässt sich nicht zeichnen: der Treiber bietet weniger als OpenGL 3.2 (Debian: apt install libegl1 libgl1-mesa-dri)</translation>
    </message>
    <message>
        <source>the graphics driver has no room for a texture of %#1 x %#2 x %#3 (OpenGL error %#4)</source>
        <translation>der Grafiktreiber hat keinen Platz für eine Textur von %#1 x %#2 x %#3 (OpenGL-Fehler %#4)</translation>
    </message>
    <message>
        <source>measuring the instrument</source>
        <translation>Instrument wird vermessen</translation>
    </message>
    <message>
        <source>slices</source>
        <translation>Schichten</translation>
    </message>
    <message>
        <source>the graphics driver adds no pictures in 32-bit colour</source>
        <translation>der Grafiktreiber addiert keine Bilder in 32-Bit-Farbe</translation>
    </message>
    <message>
        <source>a picture of %#1 x %#2 pixels; 1 to %#3 are possible</source>
        <translation>ein Bild von %#1 x %#2 Pixeln; möglich sind 1 bis %#3</translation>
    </message>
    <message>
        <source>a picture of %#1 x %#2 pixels; %3 draws up to %#4</source>
        <translation>ein Bild von %#1 x %#2 Pixeln; %3 zeichnet bis %#4</translation>
    </message>
    <message>
        <source>%1 gave no picture back</source>
        <translation>%1 gab kein Bild zurück</translation>
    </message>
    <message>
        <source>%1: cannot be written: %~2</source>
        <translation>%1: lässt sich nicht schreiben: %~2</translation>
    </message>
    <message>
        <source>%1: a picture of %#2 x %#3 pixels with %#4 values cannot be written</source>
        <translation>%1: ein Bild von %#2 x %#3 Pixeln mit %#4 Werten lässt sich nicht schreiben</translation>
    </message>
    <message>
        <source>the picture could not be encoded</source>
        <translation>das Bild ließ sich nicht kodieren</translation>
    </message>
    <message>
        <source>a picture of %#1 x %#2 pixels: %#3 to %#4 are possible</source>
        <translation>ein Bild von %#1 x %#2 Pixeln: möglich sind %#3 bis %#4</translation>
    </message>
    <message>
        <source>a picture of %#1 samples a pixel: 1 to %#2 are possible</source>
        <translation>ein Bild mit %#1 Abtastungen je Pixel: möglich sind 1 bis %#2</translation>
    </message>
    <message>
        <source>drawing the picture</source>
        <translation>das Bild wird gezeichnet</translation>
    </message>
    <message>
        <source>picture: mesh %1 has no triangles</source>
        <translation>Bild: Netz %1 hat keine Dreiecke</translation>
    </message>
    <message>
        <source>Bone over %1, mm</source>
        <translation>Knochen über %1, mm</translation>
    </message>
</context>
<context>
    <name>Scene</name>
    <message>
        <source>MR '%1' cannot be registered so: the CT's middle would lie %#2 mm outside it, and at most %#3 mm are taken; check unit and decimal point of the transform</source>
        <translation>das MR „%1“ lässt sich so nicht registrieren: die Mitte des CT läge %#2 mm außerhalb, und höchstens %#3 mm werden angenommen; prüfen Sie Einheit und Dezimalpunkt der Transformation</translation>
    </message>
    <message>
        <source>MR '%1' cannot lie on the CT through '%2', which lies there through '%3'</source>
        <translation>das MR „%1“ kann nicht über „%2“ auf dem CT liegen, das dort über „%3“ liegt</translation>
    </message>
    <message>
        <source>moved along with '%1', which was registered again; register it again to know its error</source>
        <translation>mitbewegt mit „%1“, das neu registriert wurde; registrieren Sie es neu, um seinen Fehler zu kennen</translation>
    </message>
    <message>
        <source>MR '%1' is not registered: there is nothing to sign</source>
        <translation>das MR „%1“ ist nicht registriert: es gibt nichts freizugeben</translation>
    </message>
    <message>
        <source>not registered</source>
        <translation>nicht registriert</translation>
    </message>
    <message>
        <source>registered, not said how</source>
        <translation>registriert, unbekannt wie</translation>
    </message>
    <message>
        <source>registered by %~1, %~2</source>
        <translation>registriert: %~1, %~2</translation>
    </message>
    <message>
        <source>error %#1 mm (p95) %~2</source>
        <translation>Fehler %#1 mm (p95) %~2</translation>
    </message>
    <message>
        <source>its error unknown</source>
        <translation>Fehler unbekannt</translation>
    </message>
    <message>
        <source>signed off; who and when stayed where it came from</source>
        <translation>freigegeben; von wem und wann, blieb am Ursprung</translation>
    </message>
    <message>
        <source>signed off by %1 on %2</source>
        <translation>freigegeben von %1 am %2</translation>
    </message>
    <message>
        <source>not signed off</source>
        <translation>nicht freigegeben</translation>
    </message>
    <message>
        <source>screenshot</source>
        <translation>Bildschirmfoto</translation>
    </message>
    <message>
        <source>document</source>
        <translation>Dokument</translation>
    </message>
    <message>
        <source>attachment: %~1</source>
        <translation>Anlage: %~1</translation>
    </message>
    <message>
        <source>a link must be an absolute path without control characters</source>
        <translation>eine Verknüpfung muss ein absoluter Pfad ohne Steuerzeichen sein</translation>
    </message>
    <message>
        <source>it has %1</source>
        <translation>er hat %1</translation>
    </message>
    <message>
        <source>case '%1' has no attachment '%2'; it has none</source>
        <translation>der Fall „%1“ hat keine Anlage „%2“; er hat keine</translation>
    </message>
    <message>
        <source>case '%1' has no attachment '%2'%3</source>
        <translation>der Fall „%1“ hat keine Anlage „%2“%3</translation>
    </message>
    <message>
        <source>an attachment must be a recording, a screenshot, a video or a document</source>
        <translation>eine Anlage muss eine Aufzeichnung, ein Bildschirmfoto, ein Video oder ein Dokument sein</translation>
    </message>
    <message>
        <source>a case has at most %#1</source>
        <translation>ein Fall hat höchstens %#1</translation>
    </message>
    <message>
        <source>two have one name</source>
        <translation>zwei haben einen Namen</translation>
    </message>
    <message>
        <source>one is embedded and a link</source>
        <translation>eine ist eingebettet und eine Verknüpfung</translation>
    </message>
    <message>
        <source>bookmarks and stills are of a video</source>
        <translation>Lesezeichen und Standbilder gehören zu einem Video</translation>
    </message>
    <message>
        <source>a link must have the SHA-256 of its file</source>
        <translation>eine Verknüpfung muss den SHA-256 ihrer Datei haben</translation>
    </message>
    <message>
        <source>branch '%1' has %#2 strokes, not %#3</source>
        <translation>der Zugang „%1“ hat %#2 Bohrzüge, nicht %#3</translation>
    </message>
    <message>
        <source>'%1' is in the case already; take another name than '%2', which reads the same</source>
        <translation>„%1“ ist schon im Fall; wählen Sie einen anderen Namen als „%2“, der gleich aussieht</translation>
    </message>
    <message>
        <source>MR '%1' stays: on it was drawn %~2, which comes to the CT through it; remove that first</source>
        <translation>das MR „%1“ bleibt: Darauf wurde %~2 gezeichnet, was über es zum CT kommt; entfernen Sie das erst</translation>
    </message>
    <message>
        <source>case '%1' has no part '%2' that can be removed; it has the CT alone</source>
        <translation>der Fall „%1“ hat keinen Teil „%2“, der sich entfernen lässt; er hat nur das CT</translation>
    </message>
    <message>
        <source>case '%1' has no part '%2' that can be removed; it has %3</source>
        <translation>der Fall „%1“ hat keinen Teil „%2“, der sich entfernen lässt; er hat %3</translation>
    </message>
    <message>
        <source>case '%1' has no part '%2'; it has the CT alone</source>
        <translation>der Fall „%1“ hat keinen Teil „%2“; er hat nur das CT</translation>
    </message>
    <message>
        <source>case '%1' has no part '%2'; it has %3</source>
        <translation>der Fall „%1“ hat keinen Teil „%2“; er hat %3</translation>
    </message>
    <message>
        <source>the name of a branch must be 1 to 100 bytes of UTF-8 without control characters, characters that are not seen or a dash in front</source>
        <translation>der Name eines Zugangs muss 1 bis 100 Byte UTF-8 sein, ohne Steuerzeichen, unsichtbare Zeichen oder Strich am Anfang</translation>
    </message>
    <message>
        <source>the name of a part must be 1 to 200 bytes of UTF-8 without control characters or characters that are not seen, and not 'ct' or 'ct:soft-tissue'; give one with NAME=FILE</source>
        <translation>der Name eines Teils muss 1 bis 200 Byte UTF-8 sein, ohne Steuerzeichen oder unsichtbare Zeichen, und nicht „ct“ oder „ct:soft-tissue“</translation>
    </message>
    <message>
        <source>the name of who signs must be 1 to 100 bytes of UTF-8 without control characters or characters that are not seen</source>
        <translation>der Name dessen, der freigibt, muss 1 bis 100 Byte UTF-8 sein, ohne Steuerzeichen oder unsichtbare Zeichen</translation>
    </message>
    <message>
        <source>%~1: is not UTF-8; type it anew</source>
        <translation>%~1: ist kein UTF-8; geben Sie es neu ein</translation>
    </message>
    <message>
        <source>%~1: must have 1 to 100 bytes, not %#2</source>
        <translation>%~1: muss 1 bis 100 Byte haben, nicht %#2</translation>
    </message>
    <message>
        <source>%~1: must have no control characters, nor characters that are not seen (zero-width spaces, marks of direction); type it anew</source>
        <translation>%~1: darf keine Steuerzeichen und keine unsichtbaren Zeichen haben (Leerzeichen ohne Breite, Richtungszeichen); geben Sie es neu ein</translation>
    </message>
    <message>
        <source>%~1 '%2': must be a plain name without / \ : * ? " &lt; &gt; |, a dot or space at its ends, or a dash in front</source>
        <translation>%~1 „%2“: muss ein einfacher Name sein, ohne / \ : * ? " &lt; &gt; |, Punkt oder Leerzeichen an den Enden oder Strich am Anfang</translation>
    </message>
    <message>
        <source>case name</source>
        <translation>Name des Falls</translation>
    </message>
    <message>
        <source>name of an attachment</source>
        <translation>Name einer Anlage</translation>
    </message>
    <message>
        <source>solid share</source>
        <translation>fester Anteil</translation>
    </message>
    <message>
        <source>case '%1': %#2 structures are to be drawn; at most %#3 can be, hide the others</source>
        <translation>Fall „%1“: %#2 Strukturen sollen gezeichnet werden; höchstens %#3 sind möglich, blenden Sie die anderen aus</translation>
    </message>
    <message>
        <source>label field</source>
        <translation>Labelfeld</translation>
    </message>
    <message>
        <source>it is a space without tissue</source>
        <translation>es ist ein Raum ohne Gewebe</translation>
    </message>
    <message>
        <source>its flag 'touchable' is off</source>
        <translation>sein Kennzeichen „fühlbar“ ist aus</translation>
    </message>
    <message>
        <source>rigid tissue</source>
        <translation>starres Gewebe</translation>
    </message>
    <message>
        <source>structure '%1': there is no material '%2'; give it another one (appearance --tissue)</source>
        <translation>Struktur „%1“: es gibt kein Material „%2“; geben Sie ein anderes („Der Bohrer trifft“ im Menü der Liste, F9)</translation>
    </message>
    <message>
        <source>%~1: must have at most %#2 bytes, not %#3</source>
        <translation>%~1: darf höchstens %#2 Byte haben, nicht %#3</translation>
    </message>
    <message>
        <source>%~1: must have no control characters, and be one line</source>
        <translation>%~1: darf keine Steuerzeichen haben und muss eine Zeile sein</translation>
    </message>
    <message>
        <source>%~1: must have no control characters</source>
        <translation>%~1: darf keine Steuerzeichen haben</translation>
    </message>
    <message>
        <source>%~1: must have no characters that are not seen (zero-width spaces, marks of direction); type it anew</source>
        <translation>%~1: darf keine unsichtbaren Zeichen haben (Leerzeichen ohne Breite, Richtungszeichen); geben Sie es neu ein</translation>
    </message>
    <message>
        <source>%~1: must not begin or end with a space</source>
        <translation>%~1: darf nicht mit einem Leerzeichen beginnen oder enden</translation>
    </message>
    <message>
        <source>tags: a case has at most %#1, not %#2</source>
        <translation>Schlagwörter: ein Fall hat höchstens %#1, nicht %#2</translation>
    </message>
    <message>
        <source>tag: must not be empty</source>
        <translation>Schlagwort: darf nicht leer sein</translation>
    </message>
    <message>
        <source>tags: one is there twice</source>
        <translation>Schlagwörter: eines ist zweimal da</translation>
    </message>
    <message>
        <source>side: must be left, right, both or unknown</source>
        <translation>Seite: muss links, rechts, beide oder unbekannt sein</translation>
    </message>
    <message>
        <source>history: a stroke's number is invalid</source>
        <translation>Verlauf: die Nummer eines Bohrzugs ist ungültig</translation>
    </message>
    <message>
        <source>camera: %~1</source>
        <translation>Kamera: %~1</translation>
    </message>
    <message>
        <source>history: not the text that was written</source>
        <translation>Verlauf: nicht der Text, der geschrieben wurde</translation>
    </message>
    <message>
        <source>%1 must lie within 10 km</source>
        <translation>%1 muss innerhalb von 10 km liegen</translation>
    </message>
    <message>
        <source>view_up must be a direction</source>
        <translation>view_up muss eine Richtung sein</translation>
    </message>
    <message>
        <source>parallel_scale_mm must be above 0 mm, to 10 km</source>
        <translation>parallel_scale_mm muss über 0 mm bis 10 km sein</translation>
    </message>
    <message>
        <source>view_angle_deg must lie between 0 and 180 degrees</source>
        <translation>view_angle_deg muss zwischen 0 und 180 Grad liegen</translation>
    </message>
    <message>
        <source>a number is no integer, or out of its range</source>
        <translation>eine Zahl ist keine ganze oder außerhalb ihres Bereichs</translation>
    </message>
    <message>
        <source>measuring what was laid open</source>
        <translation>das Freigelegte wird vermessen</translation>
    </message>
    <message>
        <source>what was laid open: the case's dissection is not loaded</source>
        <translation>Freigelegtes: das Präparat des Falls ist nicht geladen</translation>
    </message>
    <message>
        <source>structure '%1'</source>
        <translation>Struktur „%1“</translation>
    </message>
    <message>
        <source>what was drilled</source>
        <translation>was gebohrt wurde</translation>
    </message>
    <message>
        <source>%1: %#2 % of the face's skin would stay, as %~3 lies there and is kept with %#4 mm around it; remove it from a copy of the case first</source>
        <translation>%1: %#2 % der Gesichtshaut blieben, da %~3 dort liegt und mit %#4 mm Umgebung bleibt; entfernen Sie es erst aus einer Kopie des Falls</translation>
    </message>
    <message>
        <source>%1: %~2; it cannot be masked. Leave the image out, or hand on the region of the ear alone (--roi)</source>
        <translation>%1: %~2; es lässt sich nicht maskieren. Lassen Sie das Bild weg, oder geben Sie allein die Region des Ohrs weiter</translation>
    </message>
    <message>
        <source>%1: %~2 with %#3 mm around lies in the masked part and stays, %#4 voxels</source>
        <translation>%1: %~2 mit %#3 mm Umgebung liegt im maskierten Teil und bleibt, %#4 Voxel</translation>
    </message>
    <message>
        <source>%1: the face is masked already, but not the auricles, which are found by it; mask both in the image as it was</source>
        <translation>%1: das Gesicht ist schon maskiert, nicht aber die Ohrmuscheln, die danach gefunden werden; maskieren Sie beides im ursprünglichen Bild</translation>
    </message>
    <message>
        <source>the face is masked to a plane %#1 mm behind the tip of the nose, %#2 mm or more below its skin (median %#3 mm), with the auricles</source>
        <translation>das Gesicht ist maskiert bis zu einer Ebene %#1 mm hinter der Nasenspitze, %#2 mm oder mehr unter der Haut (Median %#3 mm), mit den Ohrmuscheln</translation>
    </message>
    <message>
        <source>the face is masked to a plane %#1 mm behind the tip of the nose, %#2 mm or more below its skin (median %#3 mm)</source>
        <translation>das Gesicht ist maskiert bis zu einer Ebene %#1 mm hinter der Nasenspitze, %#2 mm oder mehr unter der Haut (Median %#3 mm)</translation>
    </message>
    <message>
        <source>%1: %2; %#3 of its voxels changed</source>
        <translation>%1: %2; %#3 seiner Voxel geändert</translation>
    </message>
    <message>
        <source>%1: %~2; it stays as it is</source>
        <translation>%1: %~2; es bleibt, wie es ist</translation>
    </message>
    <message>
        <source>%1: all outside of the region is air; %#2 of its voxels changed</source>
        <translation>%1: alles außerhalb des Bereichs ist Luft; %#2 seiner Voxel geändert</translation>
    </message>
    <message>
        <source>the region has no voxel of the image; it is stated in patient LPS mm, as 'petrous info' states the image's origin</source>
        <translation>der Bereich hat kein Voxel des Bildes; er ist in LPS mm des Patienten anzugeben, wie der Ursprung des Bildes</translation>
    </message>
    <message>
        <source>MR '%1' is not registered, and the region is one of the CT's space; register or remove it first</source>
        <translation>das MR „%1“ ist nicht registriert, und der Bereich gehört zum Raum des CT; registrieren oder entfernen Sie es erst</translation>
    </message>
    <message>
        <source>registration: moments that no error has</source>
        <translation>Registrierung: Momente, die kein Fehler hat</translation>
    </message>
    <message>
        <source>registration: an error below 0 mm</source>
        <translation>Registrierung: ein Fehler unter 0 mm</translation>
    </message>
    <message>
        <source>provenance: assumed axes must be RAS or LPS</source>
        <translation>Herkunft: angenommene Achsen müssen RAS oder LPS sein</translation>
    </message>
    <message>
        <source>provenance: interpolated slices must be ranges of the image's slices, from 1, in order and apart</source>
        <translation>Herkunft: interpolierte Schichten müssen Bereiche der Schichten des Bildes sein, ab 1, geordnet und getrennt</translation>
    </message>
    <message>
        <source>provenance: interpolated slices beyond the image must be 0 to %#1</source>
        <translation>Herkunft: interpolierte Schichten außerhalb des Bildes müssen 0 bis %#1 sein</translation>
    </message>
    <message>
        <source>provenance: burned-in text must be none, suspected or stated</source>
        <translation>Herkunft: eingebrannter Text muss none, suspected oder stated sein</translation>
    </message>
    <message>
        <source>provenance: a ratio of compression must be above 0</source>
        <translation>Herkunft: ein Kompressionsverhältnis muss über 0 liegen</translation>
    </message>
    <message>
        <source>provenance: masked must be face, auricles or outside</source>
        <translation>Herkunft: maskiert muss face, auricles oder outside sein</translation>
    </message>
    <message>
        <source>a structure's algorithm is none of manual, semiautomatic and automatic</source>
        <translation>das Verfahren einer Struktur ist keines von manual, semiautomatic und automatic</translation>
    </message>
    <message>
        <source>of a structure's tubes more than their length is unresolved, or less than nothing</source>
        <translation>von den Röhren einer Struktur ist mehr nicht aufgelöst, als sie lang sind, oder weniger als nichts</translation>
    </message>
    <message>
        <source>clipping is no object</source>
        <translation>der Beschnitt ist kein Objekt</translation>
    </message>
    <message>
        <source>view: a burr must be cutting or diamond</source>
        <translation>Ansicht: eine Fräse muss schneidend oder Diamant sein</translation>
    </message>
    <message>
        <source>landmarks</source>
        <translation>Landmarken</translation>
    </message>
    <message>
        <source>attachment: one has neither an object nor a link</source>
        <translation>Anlage: eine hat weder ein Objekt noch eine Verknüpfung</translation>
    </message>
    <message>
        <source>case: %1 is not a finite number</source>
        <translation>Fall: %1 ist keine endliche Zahl</translation>
    </message>
    <message>
        <source>%1: written by format %#2; this program reads up to %#3. A newer version of Petrous wrote it; open it with that one, here it is left alone</source>
        <translation>%1: im Format %#2 geschrieben; dieses Programm liest bis %#3. Eine neuere Version von Petrous schrieb es; öffnen Sie es mit jener, hier bleibt es unberührt</translation>
    </message>
    <message>
        <source>%1: not a whole case manifest; restore it from a copy</source>
        <translation>%1: kein vollständiges Manifest eines Falls; stellen Sie es aus einer Kopie wieder her</translation>
    </message>
    <message>
        <source>mark</source>
        <translation>Marke</translation>
    </message>
    <message>
        <source>angle</source>
        <translation>Winkel</translation>
    </message>
    <message>
        <source>area</source>
        <translation>Fläche</translation>
    </message>
    <message>
        <source>measurement: %~1</source>
        <translation>Messung: %~1</translation>
    </message>
    <message>
        <source>a measurement must be a mark, distance, length, angle, area or thickness</source>
        <translation>eine Messung muss Marke, Abstand, Länge, Winkel, Fläche oder Dicke sein</translation>
    </message>
    <message>
        <source>a name must be 1 to %#1 bytes of UTF-8 without control characters or characters that are not seen, and without blanks at its ends</source>
        <translation>ein Name muss 1 bis %#1 Byte UTF-8 sein, ohne Steuerzeichen oder unsichtbare Zeichen und ohne Leerzeichen an den Enden</translation>
    </message>
    <message>
        <source>of the kind %~1 it has %#2 to %#3 points, not %#4</source>
        <translation>von der Art %~1 hat sie %#2 bis %#3 Punkte, nicht %#4</translation>
    </message>
    <message>
        <source>of the kind %~1 it has %#2 points, not %#3</source>
        <translation>von der Art %~1 hat sie %#2 Punkte, nicht %#3</translation>
    </message>
    <message>
        <source>a coordinate must lie within 100 m</source>
        <translation>eine Koordinate muss innerhalb von 100 m liegen</translation>
    </message>
    <message>
        <source>it has %#1 points, but images of %#2</source>
        <translation>sie hat %#1 Punkte, aber Bilder von %#2</translation>
    </message>
    <message>
        <source>case '%1' has no measurement '%2'; it has none</source>
        <translation>der Fall „%1“ hat keine Messung „%2“; er hat keine</translation>
    </message>
    <message>
        <source>case '%1' has no measurement '%2'%3</source>
        <translation>der Fall „%1“ hat keine Messung „%2“%3</translation>
    </message>
    <message>
        <source>the MR '%1', on which points were set, is not in the case any more: their error is not known</source>
        <translation>das MR „%1“, auf dem Punkte gesetzt wurden, ist nicht mehr im Fall: Ihr Fehler ist unbekannt</translation>
    </message>
    <message>
        <source>the MR '%1', on which points were set, is not registered any more: their error is not known</source>
        <translation>das MR „%1“, auf dem Punkte gesetzt wurden, ist nicht mehr registriert: Ihr Fehler ist unbekannt</translation>
    </message>
    <message>
        <source>the MR '%1', on which points were set, lies elsewhere since: their error is not known</source>
        <translation>das MR „%1“, auf dem Punkte gesetzt wurden, liegt seither anders: Ihr Fehler ist unbekannt</translation>
    </message>
    <message>
        <source>the MR '%1', from which it was made, is not in the case any more: its error is not known until it is made anew</source>
        <translation>das MR „%1“, aus dem es gemacht wurde, ist nicht mehr im Fall: Sein Fehler ist unbekannt, bis es neu gemacht wird</translation>
    </message>
    <message>
        <source>the MR '%1', from which it was made, is not registered any more: its error is not known until it is made anew</source>
        <translation>das MR „%1“, aus dem es gemacht wurde, ist nicht mehr registriert: Sein Fehler ist unbekannt, bis es neu gemacht wird</translation>
    </message>
    <message>
        <source>the MR '%1', from which it was made, lies elsewhere since: its error is not known until it is made anew</source>
        <translation>das MR „%1“, aus dem es gemacht wurde, liegt seither anders: Sein Fehler ist unbekannt, bis es neu gemacht wird</translation>
    </message>
    <message>
        <source>it was drawn on the MR '%1', which is not registered with the CT</source>
        <translation>es wurde auf dem MR „%1“ gezeichnet, das nicht mit dem CT registriert ist</translation>
    </message>
    <message>
        <source>it was drawn on the MR '%1', which is not in the case</source>
        <translation>es wurde auf dem MR „%1“ gezeichnet, das nicht im Fall ist</translation>
    </message>
    <message>
        <source>it may have been drawn on any of the MR images %~1, which have one grid; remove it and add it again as FILE@MR</source>
        <translation>es kann auf jedem der MR %~1 gezeichnet worden sein, die ein Gitter haben; entfernen Sie es, fügen Sie es noch einmal hinzu, und wählen Sie, auf welchem gezeichnet wurde</translation>
    </message>
    <message>
        <source>mutual information</source>
        <translation>Transinformation</translation>
    </message>
    <message>
        <source>by hand</source>
        <translation>von Hand</translation>
    </message>
    <message>
        <source>common frame of reference</source>
        <translation>gemeinsames Bezugssystem</translation>
    </message>
    <message>
        <source>not judged</source>
        <translation>nicht beurteilt</translation>
    </message>
    <message>
        <source>registration: there is no %~1 '%2'</source>
        <translation>Registrierung: es gibt nicht %~1 „%2“</translation>
    </message>
    <message>
        <source>the transform of a file</source>
        <translation>die Transformation einer Datei</translation>
    </message>
    <message>
        <source>hand</source>
        <translation>von Hand</translation>
    </message>
    <message>
        <source>through '%1'</source>
        <translation>über „%1“</translation>
    </message>
    <message>
        <source>structure share</source>
        <translation>Anteil der Struktur</translation>
    </message>
    <message>
        <source>video: %~1</source>
        <translation>Video: %~1</translation>
    </message>
    <message>
        <source>a still before the beginning</source>
        <translation>ein Standbild vor dem Anfang</translation>
    </message>
    <message>
        <source>a still later than 30 days</source>
        <translation>ein Standbild nach mehr als 30 Tagen</translation>
    </message>
    <message>
        <source>a still has sides of 1 to %#1 pixels</source>
        <translation>ein Standbild hat Seiten von 1 bis %#1 Pixeln</translation>
    </message>
    <message>
        <source>a still has at most %#1 landmarks</source>
        <translation>ein Standbild hat höchstens %#1 Landmarken</translation>
    </message>
    <message>
        <source>a landmark has a coordinate that is not a number or out of range</source>
        <translation>eine Landmarke hat eine Koordinate, die keine Zahl oder außerhalb des Bereichs ist</translation>
    </message>
    <message>
        <source>the angle of view must lie within 0.5 to 120 degrees</source>
        <translation>der Bildwinkel muss in 0.5 bis 120 Grad liegen</translation>
    </message>
    <message>
        <source>the opacity must lie within 0 to 1</source>
        <translation>die Deckkraft muss in 0 bis 1 liegen</translation>
    </message>
    <message>
        <source>the camera of a still must be a perspective one, of finite numbers</source>
        <translation>die Kamera eines Standbilds muss perspektivisch sein, aus endlichen Zahlen</translation>
    </message>
    <message>
        <source>one has at most %#1 bookmarks</source>
        <translation>eines hat höchstens %#1 Lesezeichen</translation>
    </message>
    <message>
        <source>one has at most %#1 stills</source>
        <translation>eines hat höchstens %#1 Standbilder</translation>
    </message>
    <message>
        <source>a bookmark's name has 1 to %#1 bytes of UTF-8, without characters that are not seen and without spaces around it</source>
        <translation>der Name eines Lesezeichens hat 1 bis %#1 Byte UTF-8, ohne unsichtbare Zeichen und ohne Leerzeichen an den Enden</translation>
    </message>
    <message>
        <source>two bookmarks have the name '%1'</source>
        <translation>zwei Lesezeichen heißen „%1“</translation>
    </message>
    <message>
        <source>bookmark '%1' is before the beginning</source>
        <translation>das Lesezeichen „%1“ liegt vor dem Anfang</translation>
    </message>
    <message>
        <source>bookmark '%1' is later than 30 days</source>
        <translation>das Lesezeichen „%1“ liegt nach mehr als 30 Tagen</translation>
    </message>
    <message>
        <source>two stills are of one frame</source>
        <translation>zwei Standbilder sind von einem Bild</translation>
    </message>
    <message>
        <source>there are '%1'</source>
        <translation>es gibt „%1“</translation>
    </message>
    <message>
        <source>the video has no bookmark '%1'; it has none</source>
        <translation>das Video hat kein Lesezeichen „%1“; es hat keines</translation>
    </message>
    <message>
        <source>the video has no bookmark '%1'%2</source>
        <translation>das Video hat kein Lesezeichen „%1“%2</translation>
    </message>
    <message>
        <source>view: %~1</source>
        <translation>Ansicht: %~1</translation>
    </message>
    <message>
        <source>window_width, of the slices' grey window, must be above 0, to 6.8e38</source>
        <translation>window_width, vom Graufenster der Schichten, muss über 0 bis 6.8e38 sein</translation>
    </message>
    <message>
        <source>window_level, of the slices' grey window, must be -3.4e38 to 3.4e38</source>
        <translation>window_level, vom Graufenster der Schichten, muss -3.4e38 bis 3.4e38 sein</translation>
    </message>
    <message>
        <source>crosshair_mm must lie within 10 km</source>
        <translation>crosshair_mm muss innerhalb von 10 km liegen</translation>
    </message>
    <message>
        <source>the zoom of a slice must be 1 to 1000</source>
        <translation>der Zoom einer Schicht muss 1 bis 1000 sein</translation>
    </message>
    <message>
        <source>offset_mm of a slice must lie within 10 km</source>
        <translation>offset_mm einer Schicht muss innerhalb von 10 km liegen</translation>
    </message>
    <message>
        <source>planes that were turned must be petrous, tool-axial, tool-coronal, tool-sagittal or free</source>
        <translation>gedrehte Ebenen müssen petrous, tool-axial, tool-coronal, tool-sagittal oder free sein</translation>
    </message>
    <message>
        <source>the axes of a plane must have length 1 and be perpendicular to each other</source>
        <translation>die Achsen einer Ebene müssen die Länge 1 haben und senkrecht zueinander stehen</translation>
    </message>
    <message>
        <source>a slab must be mip, minip or mean, above 0 to 1000 mm thick</source>
        <translation>eine dicke Schicht muss mip, minip oder mean sein, über 0 bis 1000 mm dick</translation>
    </message>
    <message>
        <source>the MR over the slices needs a name, the mode blend, edges or checker, and an opacity of 0 to 1</source>
        <translation>das MR über den Schichten braucht einen Namen, die Weise blend, edges oder checker und eine Deckkraft von 0 bis 1</translation>
    </message>
    <message>
        <source>there are at most %#1 clipping planes</source>
        <translation>es gibt höchstens %#1 Schnittebenen</translation>
    </message>
    <message>
        <source>point_mm of a clipping plane must lie within 10 km, and its normal have length 1</source>
        <translation>point_mm einer Schnittebene muss innerhalb von 10 km liegen, und ihre Normale die Länge 1 haben</translation>
    </message>
    <message>
        <source>the box of voxels that are shown must not be empty</source>
        <translation>der Bereich der gezeigten Voxel darf nicht leer sein</translation>
    </message>
    <message>
        <source>a name must be 1 to %#1 bytes of UTF-8 without characters that are not seen and without spaces around it</source>
        <translation>ein Name muss 1 bis %#1 Byte UTF-8 sein, ohne unsichtbare Zeichen und ohne Leerzeichen an den Enden</translation>
    </message>
    <message>
        <source>there are at most %#1 saved views</source>
        <translation>es gibt höchstens %#1 gespeicherte Ansichten</translation>
    </message>
    <message>
        <source>a saved view must have a camera</source>
        <translation>eine gespeicherte Ansicht muss eine Kamera haben</translation>
    </message>
    <message>
        <source>the light's falloff_mm must be 0 to 10000 mm, the wetness 0 to 1</source>
        <translation>der Lichtabfall (falloff_mm) muss 0 bis 10000 mm sein, die Nässe 0 bis 1</translation>
    </message>
    <message>
        <source>the exposure_ev must be -4 to 4 EV</source>
        <translation>die Belichtung (exposure_ev) muss -4 bis 4 EV sein</translation>
    </message>
    <message>
        <source>the edges' emphasis must be 0 to 1</source>
        <translation>die Betonung der Kanten muss 0 bis 1 sein</translation>
    </message>
    <message>
        <source>the grain of cut bone must be 0 to 1</source>
        <translation>die Körnung von abgetragenem Knochen muss 0 bis 1 sein</translation>
    </message>
    <message>
        <source>the stereo mode is unknown</source>
        <translation>der Stereomodus ist unbekannt</translation>
    </message>
    <message>
        <source>eyes must be 0 to 200 mm apart, and converge at 1 to 10000 mm</source>
        <translation>die Augen müssen 0 bis 200 mm auseinander stehen und sich bei 1 bis 10000 mm treffen</translation>
    </message>
    <message>
        <source>a burr must be 0.01 to 100 mm wide and turn at 0 to 1000000 rpm, with a thrust of 0 to 100 N</source>
        <translation>eine Fräse muss 0.01 bis 100 mm breit sein und mit 0 bis 1000000 U/min drehen, bei einem Andruck von 0 bis 100 N</translation>
    </message>
    <message>
        <source>a handpiece must be turned by -180 to 180 and tilted by 0 to 90 degrees</source>
        <translation>ein Handstück muss um -180 bis 180 Grad gedreht und um 0 bis 90 Grad geneigt sein</translation>
    </message>
    <message>
        <source>an instrument lies along x+, x-, y+, y-, z+ or z-</source>
        <translation>ein Instrument liegt entlang x+, x-, y+, y-, z+ oder z-</translation>
    </message>
    <message>
        <source>the name of an instrument must be at most %#1 bytes of UTF-8 without characters that are not seen</source>
        <translation>der Name eines Instruments darf höchstens %#1 Byte UTF-8 lang sein, ohne Zeichen, die man nicht sieht</translation>
    </message>
</context>
<context>
    <name>Segmentation</name>
    <message>
        <source>the seed at %~1 lies outside the image; give a point inside the structure</source>
        <translation>der Startpunkt bei %~1 liegt außerhalb des Bildes; geben Sie einen Punkt in der Struktur</translation>
    </message>
    <message>
        <source>threshold: the lower limit (%~1) is above the upper one (%~2); give them in ascending order</source>
        <translation>Schwelle: die untere Grenze (%~1) liegt über der oberen (%~2); geben Sie sie aufsteigend</translation>
    </message>
    <message>
        <source>region: give a point inside the structure</source>
        <translation>Bereich: geben Sie einen Punkt in der Struktur</translation>
    </message>
    <message>
        <source>the voxel at the seed (%~1) has %~2, which is not between %#3 and %~4; choose a point inside the structure, or other limits</source>
        <translation>das Voxel am Startpunkt (%~1) hat %~2, nicht zwischen %#3 und %~4; wählen Sie einen Punkt in der Struktur oder andere Grenzen</translation>
    </message>
    <message>
        <source>region: give a number of standard deviations above 0</source>
        <translation>Bereich: geben Sie eine Zahl von Standardabweichungen über 0</translation>
    </message>
    <message>
        <source>region: the image has no value at the seed; choose a point inside the structure</source>
        <translation>Bereich: das Bild hat am Startpunkt keinen Wert; wählen Sie einen Punkt in der Struktur</translation>
    </message>
    <message>
        <source>growing: draw a stroke inside the structure first</source>
        <translation>Wachsen: malen Sie erst einen Strich in der Struktur</translation>
    </message>
    <message>
        <source>growing: draw a stroke beside the structure, in what does not belong to it</source>
        <translation>Wachsen: malen Sie einen Strich neben der Struktur, in dem, was nicht zu ihr gehört</translation>
    </message>
    <message>
        <source>growing: the strokes span %#1 million voxels, more than the %#2 million possible; draw them closer to the structure</source>
        <translation>Wachsen: die Striche umspannen %#1 Millionen Voxel, mehr als die möglichen %#2 Millionen; malen Sie sie näher an der Struktur</translation>
    </message>
    <message>
        <source>growing: the image has no values around the strokes</source>
        <translation>Wachsen: das Bild hat um die Striche keine Werte</translation>
    </message>
    <message>
        <source>growing: draw strokes of both kinds inside the box</source>
        <translation>Wachsen: malen Sie Striche beider Arten im Bereich</translation>
    </message>
    <message>
        <source>islands: give a volume of 0 mm3 or more</source>
        <translation>Inseln: geben Sie ein Volumen ab 0 mm³</translation>
    </message>
    <message>
        <source>mask: the grids differ; use masks of one image</source>
        <translation>Maske: die Gitter unterscheiden sich; nehmen Sie Masken eines Bildes</translation>
    </message>
    <message>
        <source>mask: label 0 is the background; give 1 to 65535</source>
        <translation>Maske: Label 0 ist der Hintergrund; geben Sie 1 bis 65535</translation>
    </message>
    <message>
        <source>mask: a step is under way; end it first</source>
        <translation>Maske: ein Schritt läuft; beenden Sie ihn erst</translation>
    </message>
    <message>
        <source>mask: no step is under way; begin one first</source>
        <translation>Maske: kein Schritt läuft; beginnen Sie erst einen</translation>
    </message>
    <message>
        <source>mask: there is no step to undo</source>
        <translation>Maske: es gibt keinen Schritt zum Rückgängigmachen</translation>
    </message>
    <message>
        <source>mask: there is no step to redo</source>
        <translation>Maske: es gibt keinen Schritt zum Wiederherstellen</translation>
    </message>
    <message>
        <source>%~1: the grids differ; use masks and images on one grid</source>
        <translation>%~1: die Gitter unterscheiden sich; nehmen Sie Masken und Bilder auf einem Gitter</translation>
    </message>
    <message>
        <source>threshold: the lower limit (%#1) is above the upper one (%#2); give them in ascending order</source>
        <translation>Schwelle: die untere Grenze (%#1) liegt über der oberen (%#2); geben Sie sie aufsteigend</translation>
    </message>
    <message>
        <source>Otsu: give 2 to 4 classes</source>
        <translation>Otsu: geben Sie 2 bis 4 Klassen</translation>
    </message>
    <message>
        <source>Otsu: the image has too few different intensities</source>
        <translation>Otsu: das Bild hat zu wenige verschiedene Intensitäten</translation>
    </message>
    <message>
        <source>looking for the brightest region</source>
        <translation>der hellste Bereich wird gesucht</translation>
    </message>
    <message>
        <source>brush: the slice's normal has no direction</source>
        <translation>Pinsel: die Normale der Schicht hat keine Richtung</translation>
    </message>
    <message>
        <source>brush: give a radius above 0 mm, and finite positions</source>
        <translation>Pinsel: geben Sie einen Radius über 0 mm und endliche Lagen</translation>
    </message>
    <message>
        <source>brush: a range of intensities needs an image</source>
        <translation>Pinsel: eine Spanne von Intensitäten braucht ein Bild</translation>
    </message>
    <message>
        <source>margin: give a distance in mm</source>
        <translation>Rand: geben Sie einen Abstand in mm</translation>
    </message>
    <message>
        <source>smoothing: give a standard deviation of 0 mm or more</source>
        <translation>Glättung: geben Sie eine Standardabweichung ab 0 mm</translation>
    </message>
    <message>
        <source>filling between slices: the axis is 0, 1 or 2</source>
        <translation>Füllen zwischen Schichten: die Achse ist 0, 1 oder 2</translation>
    </message>
    <message>
        <source>filling between slices: there are no empty slices between drawn ones; draw the structure in two or more slices of one direction, leaving some out</source>
        <translation>Füllen zwischen Schichten: zwischen gezeichneten Schichten sind keine leeren; zeichnen Sie die Struktur in zwei oder mehr Schichten einer Richtung, und lassen Sie einige aus</translation>
    </message>
    <message>
        <source>tube: there is no line to label; trace one first</source>
        <translation>Röhre: es gibt keine Linie; verfolgen Sie erst eine</translation>
    </message>
    <message>
        <source>tube: label 0 is the background; give 1 to 65535</source>
        <translation>Röhre: Label 0 ist der Hintergrund; geben Sie 1 bis 65535</translation>
    </message>
    <message>
        <source>tube: the radii's scale must be above 0</source>
        <translation>Röhre: der Faktor der Radien muss über 0 liegen</translation>
    </message>
    <message>
        <source>label tube</source>
        <translation>Röhre wird ausgefüllt</translation>
    </message>
    <message>
        <source>tube: the image has no valid voxels around the points; set them inside the scanned field</source>
        <translation>Röhre: das Bild hat um die Punkte keine gültigen Voxel; setzen Sie sie in das Messfeld</translation>
    </message>
    <message>
        <source>tube: the image has the same value everywhere around the points; set them on a structure that differs from its surroundings</source>
        <translation>Röhre: das Bild hat um die Punkte überall den gleichen Wert; setzen Sie sie auf eine Struktur, die sich von ihrer Umgebung unterscheidet</translation>
    </message>
    <message>
        <source>trace tube</source>
        <translation>Röhre wird verfolgt</translation>
    </message>
    <message>
        <source>tube: point %#1</source>
        <translation>Röhre: Punkt %#1</translation>
    </message>
    <message>
        <source>tube: the radius %~1</source>
        <translation>Röhre: der Radius %~1</translation>
    </message>
    <message>
        <source>tube: the usual radius %~1</source>
        <translation>Röhre: der übliche Radius %~1</translation>
    </message>
    <message>
        <source>tube: the largest radius %~1</source>
        <translation>Röhre: der größte Radius %~1</translation>
    </message>
    <message>
        <source>tube: the blur %~1</source>
        <translation>Röhre: die Unschärfe %~1</translation>
    </message>
    <message>
        <source>tube: the reach %~1</source>
        <translation>Röhre: die Reichweite %~1</translation>
    </message>
    <message>
        <source>tube: the contrast from which a structure counts as resolved %~1</source>
        <translation>Röhre: der Kontrast, ab dem eine Struktur als aufgelöst gilt, %~1</translation>
    </message>
    <message>
        <source>tube: %#1 point is given; it needs 2 to %#2, typically 4 to 6 along the structure</source>
        <translation>Röhre: %#1 Punkt ist gegeben; nötig sind 2 bis %#2, üblich 4 bis 6 entlang der Struktur</translation>
    </message>
    <message>
        <source>tube: %#1 points are given; it needs 2 to %#2, typically 4 to 6 along the structure</source>
        <translation>Röhre: %#1 Punkte sind gegeben; nötig sind 2 bis %#2, üblich 4 bis 6 entlang der Struktur</translation>
    </message>
    <message>
        <source>%~1 is not a position; three finite numbers are needed</source>
        <translation>%~1 ist keine Lage; drei endliche Zahlen sind nötig</translation>
    </message>
    <message>
        <source>%~1 lies outside of the image; set it inside</source>
        <translation>%~1 liegt außerhalb des Bildes; setzen Sie ihn hinein</translation>
    </message>
    <message>
        <source>%~1 is where point %#2 is; move or remove one of them</source>
        <translation>%~1 liegt auf Punkt %#2; verschieben oder entfernen Sie einen von beiden</translation>
    </message>
    <message>
        <source>%~1 is %#2 mm from point %#3; neighbouring points may be %#4 mm apart: add points between them</source>
        <translation>%~1 liegt %#2 mm von Punkt %#3; benachbarte Punkte dürfen %#4 mm auseinander liegen: fügen Sie Punkte dazwischen ein</translation>
    </message>
</context>
<context>
    <name>Session</name>
    <message>
        <source>drill: the case's dissection is not loaded</source>
        <translation>Bohren: das Präparat des Falls ist nicht geladen</translation>
    </message>
    <message>
        <source>tool path</source>
        <translation>Werkzeugweg</translation>
    </message>
    <message>
        <source>feeling the tissue</source>
        <translation>das Gewebe wird fühlbar gemacht</translation>
    </message>
    <message>
        <source>touch: the tissue is of another case</source>
        <translation>Tastsinn: Das Gewebe ist von einem anderen Fall</translation>
    </message>
    <message>
        <source>recording: %1 is an instrument, whose surface a recording does not hold; record a burr</source>
        <translation>Aufzeichnung: %1 ist ein Instrument, dessen Oberfläche eine Aufzeichnung nicht enthält; zeichnen Sie eine Fräse auf</translation>
    </message>
    <message>
        <source>live session</source>
        <translation>laufende Sitzung</translation>
    </message>
    <message>
        <source>recording: could not be compressed</source>
        <translation>Aufzeichnung: ließ sich nicht komprimieren</translation>
    </message>
    <message>
        <source>%1: is not a recording of a session</source>
        <translation>%1: ist keine Aufzeichnung einer Sitzung</translation>
    </message>
    <message>
        <source>its head is cut short</source>
        <translation>der Kopf ist abgeschnitten</translation>
    </message>
    <message>
        <source>%1: written by format 1, which does not say what was cut; this program plays format %#2 to %#3: record it again</source>
        <translation>%1: im Format 1 geschrieben, das nicht sagt, was geschnitten wurde; dieses Programm spielt die Formate %#2 bis %#3: zeichnen Sie neu auf</translation>
    </message>
    <message>
        <source>its head is damaged</source>
        <translation>der Kopf ist beschädigt</translation>
    </message>
    <message>
        <source>its set-up is damaged</source>
        <translation>die Einrichtung darin ist beschädigt</translation>
    </message>
    <message>
        <source>block %#1</source>
        <translation>Block %#1</translation>
    </message>
    <message>
        <source>it should hold %#1 ticks and holds %#2</source>
        <translation>sie sollte %#1 Takte enthalten und enthält %#2</translation>
    </message>
    <message>
        <source>something follows its end</source>
        <translation>nach dem Ende folgt noch etwas</translation>
    </message>
    <message>
        <source>%1 does not begin as one does</source>
        <translation>%1 beginnt nicht wie einer</translation>
    </message>
    <message>
        <source>%1 is damaged (from tick %#2 on)</source>
        <translation>%1 ist beschädigt (ab Takt %#2)</translation>
    </message>
    <message>
        <source>%1: was not closed; read up to its last whole block, %#2 ticks</source>
        <translation>%1: wurde nicht geschlossen; gelesen bis zum letzten vollständigen Block, %#2 Takte</translation>
    </message>
    <message>
        <source>the recording has a gap after %#1 ticks; what follows cannot be played</source>
        <translation>die Aufzeichnung hat nach %#1 Takten eine Lücke; was folgt, lässt sich nicht abspielen</translation>
    </message>
    <message>
        <source>the cut of state %#1 of the mask, before tick %#2</source>
        <translation>der Schnitt des Standes %#1 der Maske, vor Takt %#2</translation>
    </message>
    <message>
        <source>%~1 burr %#2 mm, %#3 degrees of freedom</source>
        <translation>Fräse %~1 %#2 mm, %#3 Freiheitsgrade</translation>
    </message>
    <message>
        <source>recording: %1 is not a finite number</source>
        <translation>Aufzeichnung: %1 ist keine endliche Zahl</translation>
    </message>
    <message>
        <source>recording: a text of the set-up is not UTF-8</source>
        <translation>Aufzeichnung: ein Text der Einrichtung ist kein UTF-8</translation>
    </message>
    <message>
        <source>recording: the set-up names an unknown burr</source>
        <translation>Aufzeichnung: die Einrichtung nennt eine unbekannte Fräse</translation>
    </message>
    <message>
        <source>recording: the set-up cannot be read; it is damaged or of another program</source>
        <translation>Aufzeichnung: die Einrichtung ist nicht lesbar; sie ist beschädigt oder von einem anderen Programm</translation>
    </message>
    <message>
        <source>recording: the set-up's texts are longer than 1 MB</source>
        <translation>Aufzeichnung: die Texte der Einrichtung sind länger als 1 MB</translation>
    </message>
    <message>
        <source>%1: could not be written (%~2)</source>
        <translation>%1: ließ sich nicht schreiben (%~2)</translation>
    </message>
    <message>
        <source>The recording ended: %~1.</source>
        <translation>Die Aufzeichnung endete: %~1.</translation>
    </message>
    <message>
        <source>The recording ended: the program stood still for longer than it can bridge. It holds the session up to there.</source>
        <translation>Die Aufzeichnung endete: Das Programm stand länger still, als sie überbrücken kann. Sie enthält die Sitzung bis dahin.</translation>
    </message>
    <message>
        <source>drill: the spindle's speed must be at least 0 turns a minute</source>
        <translation>Bohren: die Drehzahl muss mindestens 0 U/min sein</translation>
    </message>
    <message>
        <source>%~1 failed: %~2</source>
        <translation>%~1 misslang: %~2</translation>
    </message>
    <message>
        <source>Closing the stroke</source>
        <translation>Das Schließen des Bohrzugs</translation>
    </message>
    <message>
        <source>Passing on what was cut</source>
        <translation>Das Weitergeben des Geschnittenen</translation>
    </message>
    <message>
        <source>shaft and handpiece</source>
        <translation>Schaft und Handstück</translation>
    </message>
    <message>
        <source>the shaft</source>
        <translation>der Schaft</translation>
    </message>
    <message>
        <source>the handpiece</source>
        <translation>das Handstück</translation>
    </message>
    <message>
        <source>The computer stood still for a moment; the tool stays where it was, and the force comes back slowly.</source>
        <translation>Der Rechner stand einen Augenblick still; das Werkzeug bleibt, wo es war, und die Kraft kehrt langsam zurück.</translation>
    </message>
    <message>
        <source>The computer's clock ran back; there is no force until it runs on.</source>
        <translation>Die Uhr des Rechners lief zurück; ohne Kraft, bis sie weiterläuft.</translation>
    </message>
    <message>
        <source>A setting of the device is out of its range; there is no force until it is put right.</source>
        <translation>Eine Einstellung des Geräts liegt außerhalb ihres Bereichs; ohne Kraft, bis sie berichtigt ist.</translation>
    </message>
    <message>
        <source>The tool stands inside tissue; it has no force until it is drawn out.</source>
        <translation>Das Werkzeug steckt in Gewebe; ohne Kraft, bis es herausgezogen ist.</translation>
    </message>
    <message>
        <source>Tissue came back where the tool was; the tool went back on its path.</source>
        <translation>Gewebe kam zurück, wo das Werkzeug war; das Werkzeug ging auf seinem Weg zurück.</translation>
    </message>
    <message>
        <source>The force could not be computed; there is none for a moment.</source>
        <translation>Die Kraft ließ sich nicht berechnen; einen Augenblick ist keine da.</translation>
    </message>
    <message>
        <source>The servo reports a fault that this program does not know.</source>
        <translation>Die Regelung meldet einen Fehler, den dieses Programm nicht kennt.</translation>
    </message>
    <message>
        <source>the tick's number</source>
        <translation>die Nummer des Taktes</translation>
    </message>
    <message>
        <source>the device's reading</source>
        <translation>die Ablesung des Geräts</translation>
    </message>
    <message>
        <source>the device's pose in the patient</source>
        <translation>die Lage des Geräts im Patienten</translation>
    </message>
    <message>
        <source>the tool's pose</source>
        <translation>die Lage des Werkzeugs</translation>
    </message>
    <message>
        <source>the force</source>
        <translation>die Kraft</translation>
    </message>
    <message>
        <source>what the device was sent</source>
        <translation>was dem Gerät gesendet wurde</translation>
    </message>
    <message>
        <source>the contact</source>
        <translation>der Kontakt</translation>
    </message>
    <message>
        <source>the state of the mask</source>
        <translation>der Stand der Maske</translation>
    </message>
    <message>
        <source>contacts, faults or drill</source>
        <translation>Kontakte, Fehler oder Bohrer</translation>
    </message>
</context>
<context>
    <name>Sound</name>
    <message>
        <source>sound: the rate must lie within 8000 to 192000 samples a second</source>
        <translation>Ton: die Abtastrate muss zwischen 8000 und 192000 Werten je Sekunde liegen</translation>
    </message>
    <message>
        <source>%1 has no function %2, which PortAudio 19 has</source>
        <translation>%1 hat keine Funktion %2, die PortAudio 19 hat</translation>
    </message>
    <message>
        <source>There is no sound: PortAudio (package libportaudio2) is not installed</source>
        <translation>Es gibt keinen Ton: PortAudio (Paket libportaudio2) ist nicht installiert</translation>
    </message>
    <message>
        <source>There is no sound: PortAudio finds no sound system</source>
        <translation>Es gibt keinen Ton: PortAudio findet kein Tonsystem</translation>
    </message>
    <message>
        <source>There is no sound: the computer has no sound output</source>
        <translation>Es gibt keinen Ton: der Rechner hat keine Tonausgabe</translation>
    </message>
    <message>
        <source>There is no sound: the sound output cannot be opened; another program may have it</source>
        <translation>Es gibt keinen Ton: die Tonausgabe lässt sich nicht öffnen; vielleicht hat sie ein anderes Programm</translation>
    </message>
    <message>
        <source>There is no sound: the sound output does not start</source>
        <translation>Es gibt keinen Ton: die Tonausgabe beginnt nicht</translation>
    </message>
</context>
<context>
    <name>Video</name>
    <message>
        <source>GStreamer cannot be started: %~1</source>
        <translation>GStreamer lässt sich nicht starten: %~1</translation>
    </message>
    <message>
        <source>GStreamer cannot be started</source>
        <translation>GStreamer lässt sich nicht starten</translation>
    </message>
    <message>
        <source>%1: GStreamer's element '%2' is missing; install Debian's package %3</source>
        <translation>%1: GStreamers Element „%2“ fehlt; installieren Sie Debians Paket %3</translation>
    </message>
    <message>
        <source>and %1</source>
        <translation>und %1</translation>
    </message>
    <message>
        <source>packages %~1</source>
        <translation>die Pakete %~1</translation>
    </message>
    <message>
        <source>package %~1</source>
        <translation>das Paket %~1</translation>
    </message>
    <message>
        <source>%1: it cannot be read any more</source>
        <translation>%1: nicht mehr lesbar</translation>
    </message>
    <message>
        <source>%1: the file is empty</source>
        <translation>%1: die Datei ist leer</translation>
    </message>
    <message>
        <source>%1: no decoder for it is installed (%~2); install Debian's %~3</source>
        <translation>%1: Kein Decoder dafür ist installiert (%~2); installieren Sie von Debian %~3</translation>
    </message>
    <message>
        <source>%1: not a video that can be read; a file such as MP4, MOV, MKV, WebM or AVI is wanted</source>
        <translation>%1: kein lesbares Video; gewünscht ist eine Datei wie MP4, MOV, MKV, WebM oder AVI</translation>
    </message>
    <message>
        <source>%1: it has sound only, and no picture</source>
        <translation>%1: hat nur Ton und kein Bild</translation>
    </message>
    <message>
        <source>%1: damaged, or not whole: no frame of it can be decoded; copy it anew</source>
        <translation>%1: beschädigt oder unvollständig: kein Bild davon lässt sich dekodieren; kopieren Sie es neu</translation>
    </message>
    <message>
        <source>%1: AVI does not tell when the frames of such an H.264 video are shown; convert it to MP4 (ffmpeg -i video.avi video.mp4)</source>
        <translation>%1: AVI sagt nicht, wann die Bilder eines solchen H.264-Videos gezeigt werden; wandeln Sie es in MP4 um (ffmpeg -i video.avi video.mp4)</translation>
    </message>
    <message>
        <source>%1: the decoder does not answer; open it again</source>
        <translation>%1: der Decoder antwortet nicht; öffnen Sie es noch einmal</translation>
    </message>
    <message>
        <source>video support was not built: this program was built without GStreamer (Debian's libgstreamer-plugins-base1.0-dev)</source>
        <translation>ohne Video: dieses Programm wurde ohne GStreamer gebaut (Debian: libgstreamer-plugins-base1.0-dev)</translation>
    </message>
</context>
<context>
    <name>Volume</name>
    <message>
        <source>no face in this volume: %~1</source>
        <translation>kein Gesicht in diesem Volumen: %~1</translation>
    </message>
    <message>
        <source>the front of the head is flat; its face is masked already</source>
        <translation>die Vorderseite des Kopfes ist flach; das Gesicht ist schon maskiert</translation>
    </message>
    <message>
        <source>the skin of a head lies in this volume, but where its face is cannot be told: %~1</source>
        <translation>die Haut eines Kopfes liegt in diesem Volumen, wo aber das Gesicht ist, lässt sich nicht sagen: %~1</translation>
    </message>
    <message>
        <source>looking for a face</source>
        <translation>ein Gesicht wird gesucht</translation>
    </message>
    <message>
        <source>its halves can be told apart in two ways</source>
        <translation>seine Hälften lassen sich auf zwei Weisen trennen</translation>
    </message>
    <message>
        <source>the field of view ends before it</source>
        <translation>das Bildfeld endet davor</translation>
    </message>
    <message>
        <source>only a part of a face lies in this volume</source>
        <translation>nur ein Teil eines Gesichts liegt in diesem Volumen</translation>
    </message>
    <message>
        <source>its halves are not both in the image</source>
        <translation>seine Hälften sind nicht beide im Bild</translation>
    </message>
    <message>
        <source>it is pitched, and its chin or brow is not in the image</source>
        <translation>es ist geneigt, und Kinn oder Stirn sind nicht im Bild</translation>
    </message>
    <message>
        <source>there is no head in it</source>
        <translation>es ist kein Kopf darin</translation>
    </message>
    <message>
        <source>%~1 and %#2 other</source>
        <translation>%~1 und %#2 weitere</translation>
    </message>
    <message>
        <source>%~1 and %#2 others</source>
        <translation>%~1 und %#2 weitere</translation>
    </message>
    <message>
        <source>grid: it must have as many voxels along each axis as the volume</source>
        <translation>Gitter: Es muss entlang jeder Achse so viele Voxel haben wie das Volumen</translation>
    </message>
    <message>
        <source>grid: there is no image to be placed on it</source>
        <translation>Gitter: Es gibt kein Bild, das darauf liegen soll</translation>
    </message>
    <message>
        <source>borders of structures</source>
        <translation>Ränder der Strukturen</translation>
    </message>
    <message>
        <source>reading structures</source>
        <translation>Strukturen werden gelesen</translation>
    </message>
    <message>
        <source>smoothing structures</source>
        <translation>Strukturen werden geglättet</translation>
    </message>
    <message>
        <source>structures: their common grid of %~1 would take %~2 million voxels; drawn and felt on one of %~3</source>
        <translation>Strukturen: ihr gemeinsames Gitter von %~1 brauchte %~2 Millionen Voxel; gezeichnet und gefühlt auf einem von %~3</translation>
    </message>
    <message>
        <source>bringing structures onto one grid</source>
        <translation>Strukturen werden auf ein Gitter gebracht</translation>
    </message>
    <message>
        <source>keeping thin structures</source>
        <translation>dünne Strukturen werden erhalten</translation>
    </message>
    <message>
        <source>decimation: the surface has too many triangles</source>
        <translation>Verkleinern: die Oberfläche hat zu viele Dreiecke</translation>
    </message>
    <message>
        <source>decimation: the surface is not closed, or an edge of it has more than two triangles</source>
        <translation>Verkleinern: die Oberfläche ist nicht geschlossen, oder eine ihrer Kanten hat mehr als zwei Dreiecke</translation>
    </message>
    <message>
        <source>decimation: a closed surface has at least 4 triangles</source>
        <translation>Verkleinern: eine geschlossene Oberfläche hat mindestens 4 Dreiecke</translation>
    </message>
    <message>
        <source>decimation: the surface has no triangles</source>
        <translation>Verkleinern: die Oberfläche hat keine Dreiecke</translation>
    </message>
    <message>
        <source>decimation: the surface has %#1 pieces that are not connected, and each needs at least 4 triangles; ask for %#2 or more, or choose a threshold with less noise</source>
        <translation>Verkleinern: die Oberfläche hat %#1 Stücke, die nicht zusammenhängen, und jedes braucht mindestens 4 Dreiecke; nehmen Sie %#2 oder mehr, oder wählen Sie eine Schwelle mit weniger Rauschen</translation>
    </message>
    <message>
        <source>collapsing further edges would fold the surface or change its topology</source>
        <translation>weitere Kanten zusammenzuziehen würde die Oberfläche falten oder ihre Topologie ändern</translation>
    </message>
    <message>
        <source>making a mesh touchable</source>
        <translation>ein Netz wird fühlbar gemacht</translation>
    </message>
    <message>
        <source>mesh: the spacing of its voxels must be above 0 mm</source>
        <translation>Netz: der Abstand seiner Voxel muss über 0 mm liegen</translation>
    </message>
    <message>
        <source>it is %#1 mm thick in places and would take %#2 MB as voxels to stay whole; a mesh may take %#3 MB</source>
        <translation>es ist stellenweise %#1 mm dick und brauchte %#2 MB als Voxel, um ganz zu bleiben; ein Netz darf %#3 MB brauchen</translation>
    </message>
    <message>
        <source>it reaches %#1 mm beyond the CT, so a coordinate lost its point or is not in mm</source>
        <translation>es reicht %#1 mm über das CT hinaus, eine Koordinate verlor also ihren Punkt oder ist nicht in mm</translation>
    </message>
    <message>
        <source>it lies outside the CT</source>
        <translation>es liegt außerhalb des CT</translation>
    </message>
    <message>
        <source>it is not closed: its surface ends at %#1 edges</source>
        <translation>es ist nicht geschlossen: seine Oberfläche endet an %#1 Kanten</translation>
    </message>
    <message>
        <source>mesh: cannot become voxels: %~1</source>
        <translation>Netz: lässt sich nicht in Voxel wandeln: %~1</translation>
    </message>
</context>
<context>
    <name>Workstation</name>
    <message>
        <source>there is an approach '%1' already; take another name</source>
        <translation>ein Zugang „%1“ ist schon da; wählen Sie einen anderen Namen</translation>
    </message>
    <message>
        <source>there is an approach '%~1' already; take another name</source>
        <translation>ein Zugang „%~1“ ist schon da; wählen Sie einen anderen Namen</translation>
    </message>
    <message>
        <source>reading pictures</source>
        <translation>Bilder werden gelesen</translation>
    </message>
    <message>
        <source>looking for what no case needs</source>
        <translation>gesucht wird, was kein Fall braucht</translation>
    </message>
    <message>
        <source>looking for strokes that were not saved</source>
        <translation>nicht gespeicherte Bohrzüge werden gesucht</translation>
    </message>
    <message>
        <source>'%~1' is not a number</source>
        <translation>„%~1“ ist keine Zahl</translation>
    </message>
    <message>
        <source>material '%1' is that of a structure of the open case</source>
        <translation>Material „%1“ ist das einer Struktur des offenen Falls</translation>
    </message>
    <message>
        <source>device test</source>
        <translation>Gerätetest</translation>
    </message>
    <message>
        <source>The case keeps %#1 views, and no more; type the name of one to replace it, or remove one first</source>
        <translation>Der Fall behält %#1 Ansichten, nicht mehr; geben Sie den Namen einer ein, um sie zu ersetzen, oder entfernen Sie erst eine</translation>
    </message>
    <message>
        <source>A name has 1 to 60 bytes.</source>
        <translation>Ein Name hat 1 bis 60 Byte.</translation>
    </message>
    <message>
        <source>the clipboard holds no transfer function</source>
        <translation>die Zwischenablage enthält keine Transferfunktion</translation>
    </message>
    <message>
        <source>measuring meshes</source>
        <translation>Netze werden vermessen</translation>
    </message>
    <message>
        <source>the file of '%1' is %~2</source>
        <translation>die Datei von „%1“: %~2</translation>
    </message>
    <message>
        <source>choose the two bookmarks in the list between which it is repeated (Ctrl and a click)</source>
        <translation>wählen Sie in der Liste die zwei Lesezeichen, zwischen denen wiederholt wird (Strg und Klick)</translation>
    </message>
</context>
<context>
    <name>Progress</name>
    <message>
        <source>reading DICOM headers</source>
        <translation>DICOM-Header werden gelesen</translation>
    </message>
    <message>
        <source>writing DICOM slices</source>
        <translation>DICOM-Schichten werden geschrieben</translation>
    </message>
    <message>
        <source>writing segments</source>
        <translation>Segmente werden geschrieben</translation>
    </message>
    <message>
        <source>restoring</source>
        <translation>Wiederherstellung</translation>
    </message>
    <message>
        <source>archiving</source>
        <translation>Archivierung</translation>
    </message>
    <message>
        <source>saving</source>
        <translation>Speichern</translation>
    </message>
    <message>
        <source>repairing</source>
        <translation>Reparatur</translation>
    </message>
    <message>
        <source>scanning the phantom</source>
        <translation>das Phantom wird gescannt</translation>
    </message>
    <message>
        <source>labelling the phantom</source>
        <translation>das Phantom wird segmentiert</translation>
    </message>
    <message>
        <source>measuring and writing surfaces</source>
        <translation>Oberflächen werden vermessen und geschrieben</translation>
    </message>
    <message>
        <source>registration's error</source>
        <translation>Fehler der Registrierung</translation>
    </message>
    <message>
        <source>registration's verdict</source>
        <translation>Urteil über die Registrierung</translation>
    </message>
    <message>
        <source>fitting</source>
        <translation>Anpassung</translation>
    </message>
    <message>
        <source>reference picture</source>
        <translation>Referenzbild</translation>
    </message>
    <message>
        <source>masking</source>
        <translation>Maskierung</translation>
    </message>
    <message>
        <source>decimation</source>
        <translation>Dezimierung</translation>
    </message>
</context>
<context>
    <name>Assembled</name>
    <message>
        <source>%1 touched (± %#2 mm)</source>
        <translation>%1 berührt (± %#2 mm)</translation>
    </message>
    <message>
        <source>under 0.01 mm³</source>
        <translation>unter 0.01 mm³</translation>
    </message>
    <message>
        <source>show bone</source>
        <translation>Knochen zeigen</translation>
    </message>
    <message>
        <source>show tissue</source>
        <translation>Gewebe zeigen</translation>
    </message>
    <message>
        <source>hide bone</source>
        <translation>Knochen ausblenden</translation>
    </message>
    <message>
        <source>hide tissue</source>
        <translation>Gewebe ausblenden</translation>
    </message>
    <message>
        <source>view '%1'</source>
        <translation>Ansicht „%1“</translation>
    </message>
    <message>
        <source>removal of view '%1'</source>
        <translation>Entfernen der Ansicht „%1“</translation>
    </message>
    <message>
        <source>at (%#1, %#2, %#3)</source>
        <translation>bei (%#1, %#2, %#3)</translation>
    </message>
    <message>
        <source>at the middle of '%1'</source>
        <translation>in der Mitte von „%1“</translation>
    </message>
    <message>
        <source>at the centre of the %~1</source>
        <translation>in der Mitte des %~1</translation>
    </message>
    <message>
        <source>at the centre of what both images show</source>
        <translation>in der Mitte dessen, was beide Bilder zeigen</translation>
    </message>
    <message>
        <source>preset of %1</source>
        <translation>Vorgabe von %1</translation>
    </message>
    <message>
        <source>preset of bone</source>
        <translation>Vorgabe des Knochens</translation>
    </message>
    <message>
        <source>preset of tissue</source>
        <translation>Vorgabe des Gewebes</translation>
    </message>
    <message>
        <source>visibility of %1</source>
        <translation>Sichtbarkeit von %1</translation>
    </message>
    <message>
        <source>visibility of bone</source>
        <translation>Sichtbarkeit des Knochens</translation>
    </message>
    <message>
        <source>visibility of tissue</source>
        <translation>Sichtbarkeit des Gewebes</translation>
    </message>
    <message>
        <source>touch of %1</source>
        <translation>Fühlbarkeit von %1</translation>
    </message>
    <message>
        <source>touch of bone</source>
        <translation>Fühlbarkeit des Knochens</translation>
    </message>
    <message>
        <source>touch of tissue</source>
        <translation>Fühlbarkeit des Gewebes</translation>
    </message>
    <message>
        <source>drilling of %1</source>
        <translation>Bohrbarkeit von %1</translation>
    </message>
    <message>
        <source>drilling of bone</source>
        <translation>Bohrbarkeit des Knochens</translation>
    </message>
    <message>
        <source>drilling of tissue</source>
        <translation>Bohrbarkeit des Gewebes</translation>
    </message>
    <message>
        <source>solidity of %1</source>
        <translation>Art (Gewebe oder Hohlraum) von %1</translation>
    </message>
    <message>
        <source>solidity of bone</source>
        <translation>Art (Gewebe oder Hohlraum) des Knochens</translation>
    </message>
    <message>
        <source>solidity of tissue</source>
        <translation>Art (Gewebe oder Hohlraum) des Gewebes</translation>
    </message>
    <message>
        <source>material of %1</source>
        <translation>Material von %1</translation>
    </message>
    <message>
        <source>material of bone</source>
        <translation>Material des Knochens</translation>
    </message>
    <message>
        <source>material of tissue</source>
        <translation>Material des Gewebes</translation>
    </message>
    <message>
        <source>stiffness of %1</source>
        <translation>Steifigkeit von %1</translation>
    </message>
    <message>
        <source>stiffness of bone</source>
        <translation>Steifigkeit des Knochens</translation>
    </message>
    <message>
        <source>stiffness of tissue</source>
        <translation>Steifigkeit des Gewebes</translation>
    </message>
    <message>
        <source>warning distance of %1</source>
        <translation>Warnabstand von %1</translation>
    </message>
    <message>
        <source>warning distance of bone</source>
        <translation>Warnabstand des Knochens</translation>
    </message>
    <message>
        <source>warning distance of tissue</source>
        <translation>Warnabstand des Gewebes</translation>
    </message>
    <message>
        <source>opacity of %1</source>
        <translation>Deckkraft von %1</translation>
    </message>
    <message>
        <source>opacity of bone</source>
        <translation>Deckkraft des Knochens</translation>
    </message>
    <message>
        <source>opacity of tissue</source>
        <translation>Deckkraft des Gewebes</translation>
    </message>
    <message>
        <source>transfer function of %1</source>
        <translation>Transferfunktion von %1</translation>
    </message>
    <message>
        <source>transfer function of bone</source>
        <translation>Transferfunktion des Knochens</translation>
    </message>
    <message>
        <source>transfer function of tissue</source>
        <translation>Transferfunktion des Gewebes</translation>
    </message>
    <message>
        <source>colour of %1</source>
        <translation>Farbe von %1</translation>
    </message>
    <message>
        <source>colour of bone</source>
        <translation>Farbe des Knochens</translation>
    </message>
    <message>
        <source>colour of tissue</source>
        <translation>Farbe des Gewebes</translation>
    </message>
    <message>
        <source>image of %1</source>
        <translation>Bild für %1</translation>
    </message>
    <message>
        <source>image of bone</source>
        <translation>Bild für den Knochen</translation>
    </message>
    <message>
        <source>image of tissue</source>
        <translation>Bild für das Gewebe</translation>
    </message>
    <message>
        <source>shininess of %1</source>
        <translation>Glanz von %1</translation>
    </message>
    <message>
        <source>shininess of bone</source>
        <translation>Glanz des Knochens</translation>
    </message>
    <message>
        <source>shininess of tissue</source>
        <translation>Glanz des Gewebes</translation>
    </message>
    <message>
        <source>priority of %1</source>
        <translation>Vorrang von %1</translation>
    </message>
    <message>
        <source>priority of bone</source>
        <translation>Vorrang des Knochens</translation>
    </message>
    <message>
        <source>priority of tissue</source>
        <translation>Vorrang des Gewebes</translation>
    </message>
    <message>
        <source>appearance of %1</source>
        <translation>Aussehen von %1</translation>
    </message>
    <message>
        <source>appearance of bone</source>
        <translation>Aussehen des Knochens</translation>
    </message>
    <message>
        <source>appearance of tissue</source>
        <translation>Aussehen des Gewebes</translation>
    </message>
</context>
<context>
    <name>Materials</name>
    <message>
        <source>Cortical bone</source>
        <translation>Kompakter Knochen</translation>
    </message>
    <message>
        <source>derived, within a factor of 2</source>
        <translation>abgeleitet, auf einen Faktor 2 genau</translation>
    </message>
    <message>
        <source>energy calibrated; hardness 33 to 44 HV in abstracts on human cortical bone; friction unsure (0.3 to 0.7)</source>
        <translation>Energie kalibriert; Härte 33 bis 44 HV in Abstracts über menschlichen kompakten Knochen; Reibung unsicher (0.3 bis 0.7)</translation>
    </message>
    <message>
        <source>Cellular bone</source>
        <translation>Pneumatisierter Knochen</translation>
    </message>
    <message>
        <source>assumption</source>
        <translation>Annahme</translation>
    </message>
    <message>
        <source>unsure: a third of cortical bone, about the ratio of their mineral densities</source>
        <translation>unsicher: ein Drittel von kompaktem Knochen, etwa das Verhältnis ihrer Mineraldichten</translation>
    </message>
    <message>
        <source>Ossicle</source>
        <translation>Gehörknöchelchen</translation>
    </message>
    <message>
        <source>unsure: as cortical bone</source>
        <translation>unsicher: wie kompakter Knochen</translation>
    </message>
    <message>
        <source>Nerve</source>
        <translation>Nerv</translation>
    </message>
    <message>
        <source>unsure: a tenth of cortical bone, so that an injury is rather overstated than understated</source>
        <translation>unsicher: ein Zehntel von kompaktem Knochen, sodass eine Verletzung eher zu groß als zu klein angegeben wird</translation>
    </message>
    <message>
        <source>Vessel</source>
        <translation>Gefäß</translation>
    </message>
    <message>
        <source>unsure: as nerve</source>
        <translation>unsicher: wie Nerv</translation>
    </message>
    <message>
        <source>Implant (titanium)</source>
        <translation>Implantat (Titan)</translation>
    </message>
    <message>
        <source>hardness of titanium alloys 330 to 380 HV in handbooks; energy and friction unsure</source>
        <translation>Härte von Titanlegierungen 330 bis 380 HV in Handbüchern; Energie und Reibung unsicher</translation>
    </message>
    <message>
        <source>published range</source>
        <translation>veröffentlichter Bereich</translation>
    </message>
    <message>
        <source>rake 0 to -30 degrees tested, 0 to -10 best (Krause 1987, abstract)</source>
        <translation>Spanwinkel 0 bis -30 Grad geprüft, 0 bis -10 am besten (Krause 1987, Abstract)</translation>
    </message>
    <message>
        <source>0.05 to 0.2 [Chan2016] after Misra &amp; Finnie</source>
        <translation>0.05 bis 0.2 [Chan2016] nach Misra &amp; Finnie</translation>
    </message>
    <message>
        <source>steeper than the usual one, among the best rakes on bone, 0 to -10 degrees (Krause 1987, abstract)</source>
        <translation>steiler als der übliche, unter den besten Spanwinkeln an Knochen, 0 bis -10 Grad (Krause 1987, Abstract)</translation>
    </message>
    <message>
        <source>flatter than the usual one, among the rakes tested on bone, 0 to -30 degrees (Krause 1987, abstract)</source>
        <translation>flacher als der übliche, unter den an Knochen geprüften Spanwinkeln, 0 bis -30 Grad (Krause 1987, Abstract)</translation>
    </message>
    <message>
        <source>125 to 150 micrometres (green, dental). No faster than medium while both are new: so were medium to super-coarse dental burrs (Siegel &amp; von Fraunhofer), and wear does not depend on coarse grains' size (De Pellegrin 2009)</source>
        <translation>125 bis 150 Mikrometer (grün, zahnärztlich). Nicht schneller als mittel, solange beide neu sind: so auch zahnärztliche Fräser von mittlerer bis supergrober Körnung (Siegel &amp; von Fraunhofer), und der Verschleiß hängt nicht von der Größe grober Körner ab (De Pellegrin 2009)</translation>
    </message>
    <message>
        <source>106 to 125 micrometres (blue, dental); coefficient of the usual diamond burr</source>
        <translation>106 bis 125 Mikrometer (blau, zahnärztlich); Beiwert des üblichen Diamantfräsers</translation>
    </message>
    <message>
        <source>derived, within a factor of 3</source>
        <translation>abgeleitet, auf einen Faktor 3 genau</translation>
    </message>
    <message>
        <source>53 to 63 micrometres (red, dental); coefficient in proportion to the grit below 100 micrometres</source>
        <translation>53 bis 63 Mikrometer (rot, zahnärztlich); Beiwert im Verhältnis zur Körnung unter 100 Mikrometern</translation>
    </message>
    <message>
        <source>derived, within a factor of 4</source>
        <translation>abgeleitet, auf einen Faktor 4 genau</translation>
    </message>
    <message>
        <source>20 to 30 micrometres (yellow, dental); coefficient in proportion to the grit below 100 micrometres</source>
        <translation>20 bis 30 Mikrometer (gelb, zahnärztlich); Beiwert im Verhältnis zur Körnung unter 100 Mikrometern</translation>
    </message>
    <message>
        <source>derived, within a factor of 8</source>
        <translation>abgeleitet, auf einen Faktor 8 genau</translation>
    </message>
    <message>
        <source>median nerve compressed across, shear modulus 12.9 kPa (Main 2011); range of shear waves along the sciatic nerve, 1.9 to 9.9 m/s (Neto 2024). No facial nerve was measured</source>
        <translation>N. medianus, quer gedrückt, Schubmodul 12.9 kPa (Main 2011); Bereich aus Scherwellen längs des N. ischiadicus, 1.9 bis 9.9 m/s (Neto 2024). Kein N. facialis wurde gemessen</translation>
    </message>
    <message>
        <source>Dura mater</source>
        <translation>Dura mater</translation>
    </message>
    <message>
        <source>derived, within a factor of 6</source>
        <translation>abgeleitet, auf einen Faktor 6 genau</translation>
    </message>
    <message>
        <source>tension: 68.1 MPa pooled from 17 studies (2022, doi 10.1007/s10237-022-01566-5), 31.5 MPa (Galford 1970) to 151 MPa (Pearcy 2022); 0.36 mm thick at the petrous apex, 0.68 mm temporal, 0.5 mm their geometric mean; a bare window of 10 mm is assumed</source>
        <translation>Zug: 68.1 MPa aus 17 Studien zusammen (2022, doi 10.1007/s10237-022-01566-5), 31.5 MPa (Galford 1970) bis 151 MPa (Pearcy 2022); 0.36 mm dick an der Felsenbeinspitze, 0.68 mm temporal, 0.5 mm deren geometrisches Mittel; ein freies Fenster von 10 mm ist angenommen</translation>
    </message>
    <message>
        <source>Artery</source>
        <translation>Arterie</translation>
    </message>
    <message>
        <source>common carotid artery in the living, tangent modulus 0.40 ± 0.25 MPa in diastole to 1.50 ± 2.05 MPa in systole (PMC3470810), 0.77 MPa their geometric mean; a wall of 1 mm and a lumen of 5 mm are assumed</source>
        <translation>A. carotis communis beim Lebenden, Tangentenmodul 0.40 ± 0.25 MPa in der Diastole bis 1.50 ± 2.05 MPa in der Systole (PMC3470810), 0.77 MPa deren geometrisches Mittel; eine Wand von 1 mm und ein Lumen von 5 mm sind angenommen</translation>
    </message>
    <message>
        <source>Brain</source>
        <translation>Gehirn</translation>
    </message>
    <message>
        <source>shear modulus 1.54 ± 0.27 kPa, MR elastography at 30 to 60 Hz (Streitberger 2014), one study</source>
        <translation>Schubmodul 1.54 ± 0.27 kPa, MR-Elastographie bei 30 bis 60 Hz (Streitberger 2014), eine Studie</translation>
    </message>
    <message>
        <source>Soft tumour</source>
        <translation>Weicher Tumor</translation>
    </message>
    <message>
        <source>as glioblastoma, shear modulus 1.32 ± 0.26 kPa (Streitberger 2014); of no tumour of the ear a value is known to us, and firm ones are stiffer</source>
        <translation>wie Glioblastom, Schubmodul 1.32 ± 0.26 kPa (Streitberger 2014); von keinem Tumor des Ohres ist uns ein Wert bekannt, und feste sind steifer</translation>
    </message>
    <message>
        <source>Muscle</source>
        <translation>Muskel</translation>
    </message>
    <message>
        <source>derived, within a factor of 7</source>
        <translation>abgeleitet, auf einen Faktor 7 genau</translation>
    </message>
    <message>
        <source>shear waves of 1.0 to 4.1 m/s (MR, review PMC9631468), 20 kPa at the middle of these speeds; 62.2 ± 10.3 kPa compressed by 5 N (Isogai 2022)</source>
        <translation>Scherwellen von 1.0 bis 4.1 m/s (MR, Übersicht PMC9631468), 20 kPa bei der Mitte dieser Geschwindigkeiten; 62.2 ± 10.3 kPa, mit 5 N gedrückt (Isogai 2022)</translation>
    </message>
    <message>
        <source>Fat</source>
        <translation>Fett</translation>
    </message>
    <message>
        <source>derived, within a factor of 10</source>
        <translation>abgeleitet, auf einen Faktor 10 genau</translation>
    </message>
    <message>
        <source>shear modulus 0.53 ± 0.31 kPa (porcine, Sims 2010) to 26.1 ± 19.0 kPa compressed by 1 N (subcutaneous, Isogai 2022); 6.4 kPa is the geometric mean of 1.59 kPa, three times the shear modulus, and 26.1 kPa</source>
        <translation>Schubmodul 0.53 ± 0.31 kPa (Schwein, Sims 2010) bis 26.1 ± 19.0 kPa, mit 1 N gedrückt (subkutan, Isogai 2022); 6.4 kPa ist das geometrische Mittel von 1.59 kPa, dem Dreifachen des Schubmoduls, und 26.1 kPa</translation>
    </message>
</context>
</TS>
