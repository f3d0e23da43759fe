<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="it_IT" sourcelanguage="en_GB">
<context>
    <name></name>
    <message>
        <source>Palm. abd.</source>
        <translation>Abd. palm.</translation>
    </message>
    <message>
        <source>DIP (thumb: IP)</source>
        <translation>IFD (pollice: IF)</translation>
    </message>
    <message>
        <source>Close Carpus</source>
        <translation>Chiudi Carpus</translation>
    </message>
    <message>
        <source>Choose another folder</source>
        <translation>Scegli un’altra cartella</translation>
    </message>
    <message>
        <source>Folder of patients and sessions</source>
        <translation>Cartella di pazienti e sedute</translation>
    </message>
    <message>
        <source>Flexion–extension</source>
        <translation>Flesso-estensione</translation>
    </message>
    <message>
        <source>Radial–ulnar deviation</source>
        <translation>Deviazione radio-ulnare</translation>
    </message>
    <message>
        <source>Thumb MCP, abduction–adduction</source>
        <translation>Pollice MCF, abduzione-adduzione</translation>
    </message>
    <message>
        <source>flexion</source>
        <translation>flessione</translation>
    </message>
    <message>
        <source>extension</source>
        <translation>estensione</translation>
    </message>
    <message>
        <source>radial</source>
        <translation>radiale</translation>
    </message>
    <message>
        <source>ulnar</source>
        <translation>ulnare</translation>
    </message>
    <message>
        <source>supination</source>
        <translation>supinazione</translation>
    </message>
    <message>
        <source>pronation</source>
        <translation>pronazione</translation>
    </message>
    <message>
        <source>more</source>
        <translation>di più</translation>
    </message>
    <message>
        <source>less</source>
        <translation>di meno</translation>
    </message>
    <message>
        <source>{low} to {high}</source>
        <translation>{low} a {high}</translation>
    </message>
    <message>
        <source>{first} and {last}</source>
        <translation>{first} e {last}</translation>
    </message>
    <message>
        <source>none</source>
        <translation>nessuno</translation>
    </message>
    <message>
        <source>Grip</source>
        <translation>Forza di presa</translation>
    </message>
    <message>
        <source>Key pinch</source>
        <translation>Pinza laterale</translation>
    </message>
    <message>
        <source>Three-point pinch</source>
        <translation>Pinza tridigitale</translation>
    </message>
    <message>
        <source>Tip pinch</source>
        <translation>Pinza di punta</translation>
    </message>
    <message>
        <source>Wrist circumference</source>
        <translation>Circonferenza del polso</translation>
    </message>
    <message>
        <source>Palm circumference (MCP level)</source>
        <translation>Circonferenza del palmo (MCF)</translation>
    </message>
    <message>
        <source>Figure-of-eight (hand oedema)</source>
        <translation>Figura a otto (edema della mano)</translation>
    </message>
    <message>
        <source>Volume of the hand</source>
        <translation>Volume della mano</translation>
    </message>
    <message>
        <source>Pain at rest</source>
        <translation>Dolore a riposo</translation>
    </message>
    <message>
        <source>Pain on movement</source>
        <translation>Dolore al movimento</translation>
    </message>
    <message>
        <source>MCP</source>
        <translation>MCF</translation>
    </message>
    <message>
        <source>PIP</source>
        <translation>IFP</translation>
    </message>
    <message>
        <source>DIP</source>
        <translation>IFD</translation>
    </message>
    <message>
        <source>Thumb</source>
        <translation>Pollice</translation>
    </message>
    <message>
        <source>{finger} finger</source>
        <translation>{finger}</translation>
    </message>
    <message>
        <source>Wrist, {movement}</source>
        <translation>Polso, {movement}</translation>
    </message>
    <message>
        <source>{finger}, {joint}, {movement}</source>
        <translation>{finger}, {joint}, {movement}</translation>
    </message>
    <message>
        <source>active</source>
        <translation>attiva</translation>
    </message>
    <message>
        <source>passive</source>
        <translation>passiva</translation>
    </message>
    <message>
        <source>of {most}</source>
        <translation>su {most}</translation>
    </message>
    <message>
        <source>Goniometer</source>
        <translation>Goniometro</translation>
    </message>
    <message>
        <source>Force</source>
        <translation>Forza</translation>
    </message>
    <message>
        <source>Circumference and volume</source>
        <translation>Circonferenza e volume</translation>
    </message>
    <message>
        <source>Scores</source>
        <translation>Punteggi</translation>
    </message>
    <message>
        <source>lower is better</source>
        <translation>meglio se più basso</translation>
    </message>
    <message>
        <source>higher is better</source>
        <translation>meglio se più alto</translation>
    </message>
    <message>
        <source>{side}, {day}</source>
        <translation>{side}, {day}</translation>
    </message>
    <message>
        <source>{name}, affected</source>
        <translation>{name}, colpita</translation>
    </message>
    <message>
        <source>{name} · mirrored</source>
        <translation>{name} · speculare</translation>
    </message>
    <message>
        <source>{name}, unaffected</source>
        <translation>{name}, non colpita</translation>
    </message>
    <message>
        <source>Not compared: the two sessions share no movement.</source>
        <translation>Non confrontate: le due sedute non hanno movimenti in comune.</translation>
    </message>
    <message>
        <source>Not compared: {why}.</source>
        <translation>Non confrontate: {why}.</translation>
    </message>
    <message>
        <source>No difference beyond measurement error between right and left.</source>
        <translation>Nessuna differenza oltre l’errore di misura fra destra e sinistra.</translation>
    </message>
    <message>
        <source>{movement}: {size} less on the right than on the left.</source>
        <translation>{movement}: a destra {size} meno che a sinistra.</translation>
    </message>
    <message>
        <source>{movement}: {size} more on the right than on the left.</source>
        <translation>{movement}: a destra {size} più che a sinistra.</translation>
    </message>
    <message>
        <source>{movement}: {size} less on the left than on the right.</source>
        <translation>{movement}: a sinistra {size} meno che a destra.</translation>
    </message>
    <message>
        <source>{movement}: {size} more on the left than on the right.</source>
        <translation>{movement}: a sinistra {size} più che a destra.</translation>
    </message>
    <message>
        <source>Not comparable: {why}. Values are shown without an assessment.</source>
        <translation>Non confrontabili: {why}. I valori sono mostrati senza valutazione.</translation>
    </message>
    <message>
        <source>partly occluded</source>
        <translation>in parte nascosto</translation>
    </message>
    <message>
        <source>not compared: {why}</source>
        <translation>non confrontato: {why}</translation>
    </message>
    <message>
        <source>The other hand is a comparison, not a norm: left and right differ in healthy people too.</source>
        <translation>L’altra mano è un confronto, non una norma: destra e sinistra differiscono anche nelle persone sane.</translation>
    </message>
    <message>
        <source>{name}: {what}</source>
        <translation>{name}: {what}</translation>
    </message>
    <message>
        <source>Difference</source>
        <translation>Differenza</translation>
    </message>
    <message>
        <source>not assessed</source>
        <translation>non valutato</translation>
    </message>
    <message>
        <source>improved</source>
        <translation>miglioramento</translation>
    </message>
    <message>
        <source>worse</source>
        <translation>peggioramento</translation>
    </message>
    <message>
        <source>{before} → {after} since {day}</source>
        <translation>{before} → {after} rispetto al giorno {day}</translation>
    </message>
    <message>
        <source>(MDC {size})</source>
        <translation>(MDC {size})</translation>
    </message>
    <message>
        <source>left edge</source>
        <translation>bordo sinistro</translation>
    </message>
    <message>
        <source>right edge</source>
        <translation>bordo destro</translation>
    </message>
    <message>
        <source>upper edge</source>
        <translation>bordo superiore</translation>
    </message>
    <message>
        <source>lower edge</source>
        <translation>bordo inferiore</translation>
    </message>
    <message>
        <source>top left</source>
        <translation>in alto a sinistra</translation>
    </message>
    <message>
        <source>top right</source>
        <translation>in alto a destra</translation>
    </message>
    <message>
        <source>bottom left</source>
        <translation>in basso a sinistra</translation>
    </message>
    <message>
        <source>bottom right</source>
        <translation>in basso a destra</translation>
    </message>
    <message>
        <source>left</source>
        <translation>a sinistra</translation>
    </message>
    <message>
        <source>right</source>
        <translation>a destra</translation>
    </message>
    <message>
        <source>top</source>
        <translation>in alto</translation>
    </message>
    <message>
        <source>bottom</source>
        <translation>in basso</translation>
    </message>
    <message>
        <source>middle</source>
        <translation>medio</translation>
    </message>
    <message>
        <source>centre</source>
        <translation>al centro</translation>
    </message>
    <message>
        <source>Move the board to the {place}</source>
        <translation>Portare la tavola {place}</translation>
    </message>
    <message>
        <source>Tilt the board: {side} nearer</source>
        <translation>Inclinare la tavola: {side} più vicino</translation>
    </message>
    <message>
        <source>Move the board nearer</source>
        <translation>Avvicinare la tavola</translation>
    </message>
    <message>
        <source>Hold still.</source>
        <translation>Tenere ferma.</translation>
    </message>
    <message>
        <source>Distance</source>
        <translation>Distanza</translation>
    </message>
    <message>
        <source>Calculate · show the board</source>
        <translation>Calcola · mostrare la tavola</translation>
    </message>
    <message>
        <source>Calculate · 1 more image</source>
        <translation>Calcola · manca 1 immagine</translation>
    </message>
    <message>
        <source>Calculate · {count} more images</source>
        <translation>Calcola · mancano {count} immagini</translation>
    </message>
    <message>
        <source>Calculate</source>
        <translation>Calcola</translation>
    </message>
    <message>
        <source>Not good enough: reprojection error {error} px.</source>
        <translation>Precisione insufficiente: errore di riproiezione {error} px.</translation>
    </message>
    <message>
        <source>Depth and colour are misaligned by {apart} px.</source>
        <translation>Profondità e colore sono sfasati di {apart} px.</translation>
    </message>
    <message>
        <source>The reprojection error is {error} pixels.</source>
        <translation>L’errore di riproiezione è di {error} pixel.</translation>
    </message>
    <message>
        <source>The camera is calibrated. {depth}</source>
        <translation>La telecamera è calibrata. {depth}</translation>
    </message>
    <message>
        <source>Depth is correct.</source>
        <translation>La profondità è corretta.</translation>
    </message>
    <message>
        <source>Depth was {share} % too large.</source>
        <translation>La profondità era sovrastimata ({share} %).</translation>
    </message>
    <message>
        <source>Depth was {share} % too small.</source>
        <translation>La profondità era sottostimata ({share} %).</translation>
    </message>
    <message>
        <source>good: below {limit} px</source>
        <translation>buono: sotto {limit} px</translation>
    </message>
    <message>
        <source>fair: below {limit} px</source>
        <translation>discreto: sotto {limit} px</translation>
    </message>
    <message>
        <source>poor: above {limit} px</source>
        <translation>scarso: sopra {limit} px</translation>
    </message>
    <message>
        <source>Reprojection error</source>
        <translation>Errore di riproiezione</translation>
    </message>
    <message>
        <source>Focal length</source>
        <translation>Distanza focale</translation>
    </message>
    <message>
        <source>corrected</source>
        <translation>corretto</translation>
    </message>
    <message>
        <source>Depth</source>
        <translation>Profondità</translation>
    </message>
    <message>
        <source>Depth scale</source>
        <translation>Scala della profondità</translation>
    </message>
    <message>
        <source>{apart} px apart</source>
        <translation>scarto {apart} px</translation>
    </message>
    <message>
        <source>good: below {most} px</source>
        <translation>buono: sotto {most} px</translation>
    </message>
    <message>
        <source>Not calibrated and not checked yet.</source>
        <translation>Non ancora calibrata né controllata.</translation>
    </message>
    <message>
        <source>today</source>
        <translation>oggi</translation>
    </message>
    <message>
        <source>yesterday</source>
        <translation>ieri</translation>
    </message>
    <message>
        <source>{days} days ago</source>
        <translation>{days} giorni fa</translation>
    </message>
    <message>
        <source>This camera has not been checked yet.</source>
        <translation>Questa telecamera non è ancora stata controllata.</translation>
    </message>
    <message>
        <source>{count} of 6 markers visible. Show the whole card in the image, in even light, with its wedge upright.</source>
        <translation>{count} marcatori visibili su 6. Mostrare tutto il cartoncino, con luce uniforme e il cuneo in piedi.</translation>
    </message>
    <message>
        <source>All six markers are visible. Do not move the card.</source>
        <translation>Tutti i sei marcatori sono visibili. Non muovere il cartoncino.</translation>
    </message>
    <message>
        <source>Palmar abduction</source>
        <translation>Abd. palmare</translation>
    </message>
    <message>
        <source>TAM</source>
        <translation>TAM</translation>
    </message>
    <message>
        <source>{finger}, {joint}</source>
        <translation>{finger}, {joint}</translation>
    </message>
    <message>
        <source>In the plane of the palm (0°)</source>
        <translation>Nel piano del palmo (0°)</translation>
    </message>
    <message>
        <source>Palmar abduction {angle}</source>
        <translation>Abduzione palmare {angle}</translation>
    </message>
    <message>
        <source>Ulnar {angle}</source>
        <translation>Ulnare {angle}</translation>
    </message>
    <message>
        <source>Radial {angle}</source>
        <translation>Radiale {angle}</translation>
    </message>
    <message>
        <source>Adducted {angle}</source>
        <translation>Addotto {angle}</translation>
    </message>
    <message>
        <source>Abducted {angle}</source>
        <translation>Abdotto {angle}</translation>
    </message>
    <message>
        <source>Measurement error (MDC95)</source>
        <translation>Errore di misura (MDC95)</translation>
    </message>
    <message>
        <source>Used in progress and reports instead of the values above.</source>
        <translation>Usato in andamento e relazioni al posto dei valori sopra.</translation>
    </message>
    <message>
        <source>Not used: at least {count} people are needed.</source>
        <translation>Non usato: servono almeno {count} persone.</translation>
    </message>
    <message>
        <source>{count} people, not used</source>
        <translation>{count} persone, non usato</translation>
    </message>
    <message>
        <source>Flexion–extension, total arc</source>
        <translation>Flesso-estensione, arco totale</translation>
    </message>
    <message>
        <source>Radial–ulnar deviation, total arc</source>
        <translation>Deviazione radio-ulnare, arco totale</translation>
    </message>
    <message>
        <source>Pronation–supination, total arc</source>
        <translation>Prono-supinazione, arco totale</translation>
    </message>
    <message>
        <source>Range of motion of a finger’s MCP, PIP or DIP</source>
        <translation>Escursione di MCF, IFP o IFD di un dito</translation>
    </message>
    <message>
        <source>Range of finger abduction</source>
        <translation>Escursione dell’abduzione di un dito</translation>
    </message>
    <message>
        <source>Range of motion of the thumb joints</source>
        <translation>Escursione delle articolazioni del pollice</translation>
    </message>
    <message>
        <source>Total active motion (TAM)</source>
        <translation>Movimento attivo totale (TAM)</translation>
    </message>
    <message>
        <source>{row}, range of motion</source>
        <translation>{row}, escursione</translation>
    </message>
    <message>
        <source>Carpus: markers and set-up</source>
        <translation>Carpus: marcatori e preparazione</translation>
    </message>
    <message>
        <source>Help</source>
        <translation>Aiuto</translation>
    </message>
    <message>
        <source>Settings</source>
        <translation>Impostazioni</translation>
    </message>
    <message>
        <source>Lock</source>
        <translation>Blocco</translation>
    </message>
    <message>
        <source>Search for a patient</source>
        <translation>Cerca un paziente</translation>
    </message>
    <message>
        <source>New patient</source>
        <translation>Nuovo paziente</translation>
    </message>
    <message>
        <source>Report</source>
        <translation>Relazione</translation>
    </message>
    <message>
        <source>Export</source>
        <translation>Esporta</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Indietro</translation>
    </message>
    <message>
        <source>Start recording, or stop and review</source>
        <translation>Avvia la registrazione, o termina e rivedi</translation>
    </message>
    <message>
        <source>Pedal: continue, record, stop</source>
        <translation>Pedale: avanti, registra, termina</translation>
    </message>
    <message>
        <source>Pause or resume</source>
        <translation>Pausa o ripresa</translation>
    </message>
    <message>
        <source>Accept the proposed marker</source>
        <translation>Accetta il marcatore proposto</translation>
    </message>
    <message>
        <source>New image</source>
        <translation>Nuova immagine</translation>
    </message>
    <message>
        <source>Enlarge the image of the last session</source>
        <translation>Ingrandisci l’immagine dell’ultima seduta</translation>
    </message>
    <message>
        <source>Thumb cannot fully extend</source>
        <translation>Il pollice non si estende del tutto</translation>
    </message>
    <message>
        <source>Index finger cannot fully extend</source>
        <translation>L’indice non si estende del tutto</translation>
    </message>
    <message>
        <source>Middle finger cannot fully extend</source>
        <translation>Il medio non si estende del tutto</translation>
    </message>
    <message>
        <source>Ring finger cannot fully extend</source>
        <translation>L’anulare non si estende del tutto</translation>
    </message>
    <message>
        <source>Little finger cannot fully extend</source>
        <translation>Il mignolo non si estende del tutto</translation>
    </message>
    <message>
        <source>Play or stop</source>
        <translation>Riproduci o interrompi</translation>
    </message>
    <message>
        <source>Previous frame</source>
        <translation>Fotogramma precedente</translation>
    </message>
    <message>
        <source>Next frame</source>
        <translation>Fotogramma seguente</translation>
    </message>
    <message>
        <source>Exclude or include a repetition</source>
        <translation>Escludi o includi una ripetizione</translation>
    </message>
    <message>
        <source>Undo the last change of a repetition</source>
        <translation>Annullare l’ultima modifica di una ripetizione</translation>
    </message>
    <message>
        <source>Open the selected session</source>
        <translation>Apri la seduta selezionata</translation>
    </message>
    <message>
        <source>Correct a marker</source>
        <translation>Correggi un marcatore</translation>
    </message>
    <message>
        <source>Marker not visible here</source>
        <translation>Marcatore qui non visibile</translation>
    </message>
    <message>
        <source>Next uncertain frame</source>
        <translation>Fotogramma incerto seguente</translation>
    </message>
    <message>
        <source>Draw the angle on the frame</source>
        <translation>Disegna l’angolo sul fotogramma</translation>
    </message>
    <message>
        <source>Compare the two ticked sessions</source>
        <translation>Confronta le due sedute selezionate</translation>
    </message>
    <message>
        <source>Compare with the other hand or another day</source>
        <translation>Confronta con l’altra mano o con un altro giorno</translation>
    </message>
    <message>
        <source>Ctrl</source>
        <translation>Ctrl</translation>
    </message>
    <message>
        <source>Alt</source>
        <translation>Alt</translation>
    </message>
    <message>
        <source>Shift</source>
        <translation>Maiusc</translation>
    </message>
    <message>
        <source>Space</source>
        <translation>Spazio</translation>
    </message>
    <message>
        <source>Backspace</source>
        <translation>Backspace</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>Tab</source>
        <translation>Tab</translation>
    </message>
    <message>
        <source>Note</source>
        <translation>Nota</translation>
    </message>
    <message>
        <source>Home exercise sheet</source>
        <translation>Scheda di esercizi a casa</translation>
    </message>
    <message>
        <source>Pain score</source>
        <translation>Punteggio del dolore</translation>
    </message>
    <message>
        <source>Next marker</source>
        <translation>Marcatore seguente</translation>
    </message>
    <message>
        <source>Previous repetition</source>
        <translation>Ripetizione precedente</translation>
    </message>
    <message>
        <source>Next repetition</source>
        <translation>Ripetizione seguente</translation>
    </message>
    <message>
        <source>Uncertain</source>
        <translation>Incerto</translation>
    </message>
    <message>
        <source>Another blue spot is here</source>
        <translation>Qui c’è un altro punto blu</translation>
    </message>
    <message>
        <source>Is it the {marker}?</source>
        <translation>Questo punto è: {marker}?</translation>
    </message>
    <message>
        <source>Which blue spot is the {marker}?</source>
        <translation>Quale punto blu è: {marker}?</translation>
    </message>
    <message>
        <source>Waiting for the camera image</source>
        <translation>In attesa dell’immagine</translation>
    </message>
    <message>
        <source>Hold the hand flat under the camera</source>
        <translation>Tenere la mano piatta sotto la telecamera</translation>
    </message>
    <message>
        <source>Too few markers visible</source>
        <translation>Troppo pochi marcatori visibili</translation>
    </message>
    <message>
        <source>Turn the back of the hand to the camera</source>
        <translation>Girare il dorso della mano verso la telecamera</translation>
    </message>
    <message>
        <source>Markers do not match the hand: hold the hand flat for a moment</source>
        <translation>I marcatori non corrispondono: tenere un momento la mano piatta</translation>
    </message>
    <message>
        <source>Hold the hand flat for a moment</source>
        <translation>Tenere la mano piatta per un momento</translation>
    </message>
    <message>
        <source>All {count} markers visible</source>
        <translation>Visibili tutti i {count} marcatori</translation>
    </message>
    <message>
        <source>{marker} occluded</source>
        <translation>Nascosto: {marker}</translation>
    </message>
    <message>
        <source>Thumb occluded</source>
        <translation>Pollice nascosto</translation>
    </message>
    <message>
        <source>{finger} finger occluded</source>
        <translation>Nascosto: {finger}</translation>
    </message>
    <message>
        <source>Fingertips occluded</source>
        <translation>Punte delle dita nascoste</translation>
    </message>
    <message>
        <source>{count} markers occluded</source>
        <translation>{count} marcatori nascosti</translation>
    </message>
    <message>
        <source>Turn the thumb side up</source>
        <translation>Girare verso l’alto il lato del pollice</translation>
    </message>
    <message>
        <source>Raise the hand</source>
        <translation>Alzare la mano</translation>
    </message>
    <message>
        <source>Turn the back of the fingers to the camera</source>
        <translation>Girare il dorso delle dita verso la telecamera</translation>
    </message>
    <message>
        <source>Forearm moved</source>
        <translation>Avambraccio spostato</translation>
    </message>
    <message>
        <source>Lay the forearm back where it was</source>
        <translation>Rimettere l’avambraccio dov’era</translation>
    </message>
    <message>
        <source>Wrist</source>
        <translation>Polso</translation>
    </message>
    <message>
        <source>Index</source>
        <translation>Indice</translation>
    </message>
    <message>
        <source>Middle</source>
        <translation>Medio</translation>
    </message>
    <message>
        <source>Ring</source>
        <translation>Anulare</translation>
    </message>
    <message>
        <source>Little</source>
        <translation>Mignolo</translation>
    </message>
    <message>
        <source>Index finger</source>
        <translation>Indice</translation>
    </message>
    <message>
        <source>Middle finger</source>
        <translation>Medio</translation>
    </message>
    <message>
        <source>Ring finger</source>
        <translation>Anulare</translation>
    </message>
    <message>
        <source>Little finger</source>
        <translation>Mignolo</translation>
    </message>
    <message>
        <source>Click the {marker}</source>
        <translation>Fare clic su: {marker}</translation>
    </message>
    <message>
        <source>At the base of the thumb, just distal to the anatomical snuffbox.</source>
        <translation>Alla base del pollice, subito distalmente alla tabacchiera anatomica.</translation>
    </message>
    <message>
        <source>On the back of the hand, 3–5 mm proximal to the MCP joint.</source>
        <translation>Sul dorso della mano, 3–5 mm prossimalmente all’articolazione MCF.</translation>
    </message>
    <message>
        <source>Centred on the creases over the PIP joint.</source>
        <translation>Al centro delle pieghe sopra l’articolazione IFP.</translation>
    </message>
    <message>
        <source>Centred on the creases over the DIP joint.</source>
        <translation>Al centro delle pieghe sopra l’articolazione IFD.</translation>
    </message>
    <message>
        <source>Centred on the creases over the IP joint.</source>
        <translation>Al centro delle pieghe sopra l’articolazione IF.</translation>
    </message>
    <message>
        <source>Clear the view of the wrist</source>
        <translation>Liberare la vista sul polso</translation>
    </message>
    <message>
        <source>Turn the little-finger side up</source>
        <translation>Girare verso l’alto il lato del mignolo</translation>
    </message>
    <message>
        <source>Accept {count} labels</source>
        <translation>Accetta {count} etichette</translation>
    </message>
    <message>
        <source>All {count} markers found</source>
        <translation>Trovati tutti i {count} marcatori</translation>
    </message>
    <message>
        <source>Are these labels correct?</source>
        <translation>Queste etichette sono giuste?</translation>
    </message>
    <message>
        <source>1 label is uncertain</source>
        <translation>1 etichetta è incerta</translation>
    </message>
    <message>
        <source>{count} labels are uncertain</source>
        <translation>{count} etichette sono incerte</translation>
    </message>
    <message>
        <source>Check: {markers}. Press Enter to accept, or drag a label to another marker.</source>
        <translation>Controllare: {markers}. Premere Invio per accettare, o trascinare un’etichetta su un altro marcatore.</translation>
    </message>
    <message>
        <source>Is this the {marker}?</source>
        <translation>Questo marcatore è: {marker}?</translation>
    </message>
    <message>
        <source>Yes, it is</source>
        <translation>Sì</translation>
    </message>
    <message>
        <source>{named} of {asked} markers found</source>
        <translation>Trovati {named} marcatori su {asked}</translation>
    </message>
    <message>
        <source>Not found: {markers}. Press Enter to accept the others, then click these.</source>
        <translation>Non trovati: {markers}. Premere Invio per accettare gli altri, poi fare clic su questi.</translation>
    </message>
    <message>
        <source>{markers} and {count} more</source>
        <translation>{markers} e altri {count}</translation>
    </message>
    <message>
        <source>1 file was saved.</source>
        <translation>È stato salvato 1 file.</translation>
    </message>
    <message>
        <source>{count} files were saved.</source>
        <translation>Sono stati salvati {count} file.</translation>
    </message>
    <message>
        <source>Folder: {folder}</source>
        <translation>Cartella: {folder}</translation>
    </message>
    <message>
        <source>Files: {names}</source>
        <translation>File: {names}</translation>
    </message>
    <message>
        <source>Open folder</source>
        <translation>Apri la cartella</translation>
    </message>
    <message>
        <source>Continue</source>
        <translation>Continua</translation>
    </message>
    <message>
        <source>Enter</source>
        <translation>Invio</translation>
    </message>
    <message>
        <source>Markers</source>
        <translation>Marcatori</translation>
    </message>
    <message>
        <source>Camera tilt</source>
        <translation>Inclinazione</translation>
    </message>
    <message>
        <source>Hand</source>
        <translation>Mano</translation>
    </message>
    <message>
        <source>Hand length</source>
        <translation>Lunghezza</translation>
    </message>
    <message>
        <source>labels wrong</source>
        <translation>etichette errate</translation>
    </message>
    <message>
        <source>1 uncertain</source>
        <translation>1 incerto</translation>
    </message>
    <message>
        <source>{count} not found</source>
        <translation>{count} non trovati</translation>
    </message>
    <message>
        <source>within {size} mm</source>
        <translation>entro {size} mm</translation>
    </message>
    <message>
        <source>moved</source>
        <translation>mossa</translation>
    </message>
    <message>
        <source>still, flat</source>
        <translation>ferma, piatta</translation>
    </message>
    <message>
        <source>Ready</source>
        <translation>Pronto</translation>
    </message>
    <message>
        <source>Cannot start yet</source>
        <translation>Non si può ancora iniziare</translation>
    </message>
    <message>
        <source>ddd d MMM</source>
        <translation>ddd d MMM</translation>
    </message>
    <message>
        <source>d MMM</source>
        <translation>d MMM</translation>
    </message>
    <message>
        <source>{minutes} min</source>
        <translation>{minutes} min</translation>
    </message>
    <message>
        <source>more than 99 h</source>
        <translation>più di 99 h</translation>
    </message>
    <message>
        <source>{hours} h</source>
        <translation>{hours} h</translation>
    </message>
    <message>
        <source>dddd d MMMM yyyy</source>
        <translation>dddd d MMMM yyyy</translation>
    </message>
    <message>
        <source>d MMM yyyy</source>
        <translation>d MMM yyyy</translation>
    </message>
    <message>
        <source>1 week</source>
        <translation>1 settimana</translation>
    </message>
    <message>
        <source>{count} weeks</source>
        <translation>{count} settimane</translation>
    </message>
    <message>
        <source>1 day</source>
        <translation>1 giorno</translation>
    </message>
    <message>
        <source>{count} days</source>
        <translation>{count} giorni</translation>
    </message>
    <message>
        <source>{number}st</source>
        <translation>{number}ª</translation>
    </message>
    <message>
        <source>{number}nd</source>
        <translation>{number}ª</translation>
    </message>
    <message>
        <source>{number}rd</source>
        <translation>{number}ª</translation>
    </message>
    <message>
        <source>{number}th</source>
        <translation>{number}ª</translation>
    </message>
    <message>
        <source>One moment.</source>
        <translation>Un momento.</translation>
    </message>
    <message>
        <source>Show the dots</source>
        <translation>Fai vedere i bollini</translation>
    </message>
    <message>
        <source>Show the blue dots to the camera</source>
        <translation>Mostri i puntini blu alla telecamera</translation>
    </message>
    <message>
        <source>Let your hand rest.</source>
        <translation>Riposi la mano.</translation>
    </message>
    <message>
        <source>A short break.</source>
        <translation>Una piccola pausa.</translation>
    </message>
    <message>
        <source>Well done.</source>
        <translation>Molto bene.</translation>
    </message>
    <message>
        <source>Let your hand lie still</source>
        <translation>Tenga ferma la mano</translation>
    </message>
    <message>
        <source>Just try it.</source>
        <translation>Solo una prova.</translation>
    </message>
    <message>
        <source>And back</source>
        <translation>E ora torni</translation>
    </message>
    <message>
        <source>There!</source>
        <translation>Ecco!</translation>
    </message>
    <message>
        <source>As far as is comfortable</source>
        <translation>Fin dove non dà fastidio</translation>
    </message>
    <message>
        <source>Further</source>
        <translation>Ancora</translation>
    </message>
    <message>
        <source>A little further</source>
        <translation>Ancora un poco</translation>
    </message>
    <message>
        <source>A few minutes</source>
        <translation>Qualche minuto</translation>
    </message>
    <message>
        <source>About a minute</source>
        <translation>Circa un minuto</translation>
    </message>
    <message>
        <source>About half a minute</source>
        <translation>Circa mezzo minuto</translation>
    </message>
    <message>
        <source>A moment longer</source>
        <translation>Ancora un momento</translation>
    </message>
    <message>
        <source>then: {task}</source>
        <translation>poi: {task}</translation>
    </message>
    <message>
        <source>Bend your hand down</source>
        <translation>Pieghi la mano in giù</translation>
    </message>
    <message>
        <source>Lift your hand up</source>
        <translation>Sollevi la mano</translation>
    </message>
    <message>
        <source>Down</source>
        <translation>Giù</translation>
    </message>
    <message>
        <source>Up</source>
        <translation>Su</translation>
    </message>
    <message>
        <source>To the thumb</source>
        <translation>Verso il pollice</translation>
    </message>
    <message>
        <source>To the little finger</source>
        <translation>Verso il mignolo</translation>
    </message>
    <message>
        <source>Turn your palm up</source>
        <translation>Giri il palmo in su</translation>
    </message>
    <message>
        <source>Turn your palm down</source>
        <translation>Giri il palmo in giù</translation>
    </message>
    <message>
        <source>Turn up</source>
        <translation>Gira in su</translation>
    </message>
    <message>
        <source>Turn down</source>
        <translation>Gira in giù</translation>
    </message>
    <message>
        <source>Close your hand to a fist</source>
        <translation>Chiuda la mano a pugno</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Chiudi</translation>
    </message>
    <message>
        <source>Bend your fingers into a hook</source>
        <translation>Pieghi le dita a uncino</translation>
    </message>
    <message>
        <source>Hook</source>
        <translation>Fai l’uncino</translation>
    </message>
    <message>
        <source>Spread your fingers wide</source>
        <translation>Allarghi bene le dita</translation>
    </message>
    <message>
        <source>Wide</source>
        <translation>Apri le dita</translation>
    </message>
    <message>
        <source>Open your thumb wide</source>
        <translation>Apra bene il pollice</translation>
    </message>
    <message>
        <source>Thumb wide</source>
        <translation>Apri il pollice</translation>
    </message>
    <message>
        <source>Take the cup, lift it a little, put it back</source>
        <translation>Prenda il bicchiere, lo sollevi un poco, lo posi</translation>
    </message>
    <message>
        <source>Take the cup</source>
        <translation>Prendi il bicchiere</translation>
    </message>
    <message>
        <source>Move your fingers as you like</source>
        <translation>Muova le dita come vuole</translation>
    </message>
    <message>
        <source>Move your fingers</source>
        <translation>Muovi le dita</translation>
    </message>
    <message>
        <source>Move your hand as you like</source>
        <translation>Muova la mano come vuole</translation>
    </message>
    <message>
        <source>Move your hand</source>
        <translation>Muovi la mano</translation>
    </message>
    <message>
        <source>Turn your hand back</source>
        <translation>Rigiri la mano</translation>
    </message>
    <message>
        <source>Open your hand</source>
        <translation>Apra la mano</translation>
    </message>
    <message>
        <source>Straighten your fingers</source>
        <translation>Distenda le dita</translation>
    </message>
    <message>
        <source>Close your fingers</source>
        <translation>Riavvicini le dita</translation>
    </message>
    <message>
        <source>Touch the next fingertip</source>
        <translation>Tocchi la punta del dito seguente</translation>
    </message>
    <message>
        <source>Come back to the middle</source>
        <translation>Torni al centro</translation>
    </message>
    <message>
        <source>Try everything without a patient</source>
        <translation>Provare tutto senza un paziente</translation>
    </message>
    <message>
        <source>No analysed session yet</source>
        <translation>Nessuna seduta ancora analizzata</translation>
    </message>
    <message>
        <source>Carpus</source>
        <translation>Carpus</translation>
    </message>
    <message>
        <source>Reference</source>
        <translation>Riferimento</translation>
    </message>
    <message>
        <source>Limit {value}</source>
        <translation>Limite {value}</translation>
    </message>
    <message>
        <source>Mean {value}</source>
        <translation>Media {value}</translation>
    </message>
    <message>
        <source>Carpus shows {what}</source>
        <translation>Carpus indica {what}</translation>
    </message>
    <message>
        <source>Carpus shows more {what}</source>
        <translation>Carpus indica più {what}</translation>
    </message>
    <message>
        <source>hatched: within the limit you set</source>
        <translation>area a righe: entro il limite fissato</translation>
    </message>
    <message>
        <source>seconds after the first frame</source>
        <translation>secondi dal primo fotogramma</translation>
    </message>
    <message>
        <source>Reference, adults {span}</source>
        <translation>Rif. adulti {span}</translation>
    </message>
    <message>
        <source>Total arc</source>
        <translation>Arco totale</translation>
    </message>
    <message>
        <source>Measurement error ±{gap}{limit}</source>
        <translation>Err. di misura ±{gap}{limit}</translation>
    </message>
    <message>
        <source>Goal {angle}</source>
        <translation>Obiettivo {angle}</translation>
    </message>
    <message>
        <source>not compared</source>
        <translation>non confrontato</translation>
    </message>
    <message>
        <source>≥: partly occluded</source>
        <translation>≥: in parte nascosto</translation>
    </message>
    <message>
        <source>palm. abd.</source>
        <translation>abd. palm.</translation>
    </message>
    <message>
        <source>{number} (excluded)</source>
        <translation>{number} (esclusa)</translation>
    </message>
    <message>
        <source>{number} (passive)</source>
        <translation>{number} (passiva)</translation>
    </message>
    <message>
        <source>Speed</source>
        <translation>Velocità</translation>
    </message>
    <message>
        <source>no value</source>
        <translation>nessun valore</translation>
    </message>
    <message>
        <source>Flexion</source>
        <translation>Flessione</translation>
    </message>
    <message>
        <source>should stay within {angle}</source>
        <translation>deve restare entro {angle}</translation>
    </message>
    <message>
        <source>thumb ←</source>
        <translation>pollice ←</translation>
    </message>
    <message>
        <source>thumb →</source>
        <translation>pollice →</translation>
    </message>
    <message>
        <source>fingers ↑</source>
        <translation>dita ↑</translation>
    </message>
    <message>
        <source>From above</source>
        <translation>Dall’alto</translation>
    </message>
    <message>
        <source>up ↑</source>
        <translation>su ↑</translation>
    </message>
    <message>
        <source>fingers →</source>
        <translation>dita →</translation>
    </message>
    <message>
        <source>From the side</source>
        <translation>Di lato</translation>
    </message>
    <message>
        <source>From the fingers</source>
        <translation>Dalle dita</translation>
    </message>
    <message>
        <source>No sessions of this exercise yet.</source>
        <translation>Ancora nessuna seduta di questo esercizio.</translation>
    </message>
    <message>
        <source>1 session is excluded.</source>
        <translation>1 seduta è esclusa.</translation>
    </message>
    <message>
        <source>{count} sessions are excluded.</source>
        <translation>{count} sedute sono escluse.</translation>
    </message>
    <message>
        <source>Nothing to compare: {left_out}</source>
        <translation>Nulla da confrontare: {left_out}</translation>
    </message>
    <message>
        <source>At least two sessions are needed to show progress.</source>
        <translation>Per mostrare i progressi servono almeno due sedute.</translation>
    </message>
    <message>
        <source>Compare after the next session of the same kind.</source>
        <translation>Confrontare dopo la prossima seduta dello stesso tipo.</translation>
    </message>
    <message>
        <source>at least {size}</source>
        <translation>almeno {size}</translation>
    </message>
    <message>
        <source>TAM has improved in {count} of {all} fingers since {day}.</source>
        <translation>TAM migliorato in {count} dita su {all} rispetto al giorno {day}.</translation>
    </message>
    <message>
        <source>{name} has improved by {size} since {day}.</source>
        <translation>{name}: miglioramento di {size} rispetto al giorno {day}.</translation>
    </message>
    <message>
        <source>{name} has decreased by {size} since {day}.</source>
        <translation>{name}: diminuzione di {size} rispetto al giorno {day}.</translation>
    </message>
    <message>
        <source>Not assessed: the joints were partly occluded.</source>
        <translation>Non valutato: le articolazioni erano in parte nascoste.</translation>
    </message>
    <message>
        <source>Not assessed: {why}.</source>
        <translation>Non valutato: {why}.</translation>
    </message>
    <message>
        <source>too few repetitions to compare</source>
        <translation>troppo poche ripetizioni per confrontare</translation>
    </message>
    <message>
        <source>{joint} of the {finger}</source>
        <translation>{joint}, {finger}</translation>
    </message>
    <message>
        <source>The total arc</source>
        <translation>L’arco totale</translation>
    </message>
    <message>
        <source>From {before} to {after}: more than the measurement error of {limit}.</source>
        <translation>Da {before} a {after}: più dell’errore di misura di {limit}.</translation>
    </message>
    <message>
        <source>From {before} to {after}: within the measurement error of {limit}.</source>
        <translation>Da {before} a {after}: entro l’errore di misura di {limit}.</translation>
    </message>
    <message>
        <source>at least {change}</source>
        <translation>almeno {change}</translation>
    </message>
    <message>
        <source>{name}: {change}.</source>
        <translation>{name}: {change}.</translation>
    </message>
    <message>
        <source>Excluded sessions and sessions with another set-up are not compared.</source>
        <translation>Le sedute escluse o con un’altra preparazione non vengono confrontate.</translation>
    </message>
    <message>
        <source>partly occluded, or too few</source>
        <translation>in parte nascosto, o troppo poche</translation>
    </message>
    <message>
        <source>{change}, MDC {limit}</source>
        <translation>{change}, MDC {limit}</translation>
    </message>
    <message>
        <source>{day}: measured although uncertain. {findings}</source>
        <translation>{day}: misurata nonostante l’incertezza. {findings}</translation>
    </message>
    <message>
        <source>camera {step} cm further away</source>
        <translation>telecamera {step} cm più lontana</translation>
    </message>
    <message>
        <source>camera {step} cm nearer</source>
        <translation>telecamera {step} cm più vicina</translation>
    </message>
    <message>
        <source>the forearm moved {distance}</source>
        <translation>avambraccio spostato di {distance}</translation>
    </message>
    <message>
        <source>{day}: {reasons}. Excluded (shown as an open circle).</source>
        <translation>{day}: {reasons}. Esclusa (cerchio vuoto).</translation>
    </message>
    <message>
        <source>{day}: {reasons}. Excluded.</source>
        <translation>{day}: {reasons}. Esclusa.</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Telecamera</translation>
    </message>
    <message>
        <source>Frames</source>
        <translation>Fotogrammi</translation>
    </message>
    <message>
        <source>ext.</source>
        <translation>est.</translation>
    </message>
    <message>
        <source>flex.</source>
        <translation>fless.</translation>
    </message>
    <message>
        <source>Movement time</source>
        <translation>Tempo di movimento</translation>
    </message>
    <message>
        <source>Peak speed</source>
        <translation>Velocità massima</translation>
    </message>
    <message>
        <source>Time to peak</source>
        <translation>Tempo al picco</translation>
    </message>
    <message>
        <source>Path length</source>
        <translation>Lunghezza del percorso</translation>
    </message>
    <message>
        <source>Path length ratio</source>
        <translation>Rapporto percorso/retta</translation>
    </message>
    <message>
        <source>Number of speed peaks</source>
        <translation>Numero di picchi di velocità</translation>
    </message>
    <message>
        <source>Smoothness (SPARC)</source>
        <translation>Fluidità (SPARC)</translation>
    </message>
    <message>
        <source>Maximum grip aperture, thumb–index</source>
        <translation>Apertura massima pollice–indice</translation>
    </message>
    <message>
        <source>Wrist angle at grasp</source>
        <translation>Angolo del polso alla presa</translation>
    </message>
    <message>
        <source>Hand span, thumb–little</source>
        <translation>Apertura della mano, pollice–mignolo</translation>
    </message>
    <message>
        <source>Movement synergy (variance explained)</source>
        <translation>Sinergia di movimento (varianza spiegata)</translation>
    </message>
    <message>
        <source>Tremor, 3 to 12 Hz (rms)</source>
        <translation>Tremore, da 3 a 12 Hz (rms)</translation>
    </message>
    <message>
        <source>index</source>
        <translation>indice</translation>
    </message>
    <message>
        <source>ring</source>
        <translation>anulare</translation>
    </message>
    <message>
        <source>little</source>
        <translation>mignolo</translation>
    </message>
    <message>
        <source>Largest span, {one}–{other}</source>
        <translation>Ampiezza massima, {one}–{other}</translation>
    </message>
    <message>
        <source>Smallest distance, {one}–{other}</source>
        <translation>Distanza minima, {one}–{other}</translation>
    </message>
    <message>
        <source>Touches, {one}–{other}</source>
        <translation>Contatti, {one}–{other}</translation>
    </message>
    <message>
        <source>occluded</source>
        <translation>nascosto</translation>
    </message>
    <message>
        <source>Reach {time}, peak speed {speed}, path ratio {straight}, grip aperture {opening}, wrist {wrist}</source>
        <translation>Raggiungimento {time}, velocità massima {speed}, rapporto percorso/retta {straight}, apertura {opening}, polso {wrist}</translation>
    </message>
    <message>
        <source>The thumb touched {met} of {all} fingertips</source>
        <translation>Il pollice ha toccato {met} polpastrelli su {all}</translation>
    </message>
    <message>
        <source>Thumb contact was occluded</source>
        <translation>Il contatto del pollice era nascosto</translation>
    </message>
    <message>
        <source>{words}; {hidden} occluded</source>
        <translation>{words}; {hidden} nascosti</translation>
    </message>
    <message>
        <source>Reach {time}</source>
        <translation>Raggiungimento {time}</translation>
    </message>
    <message>
        <source>Reach and grasp</source>
        <translation>Raggiungere e afferrare</translation>
    </message>
    <message>
        <source>Thumb to the fingertips</source>
        <translation>Pollice alle punte delle dita</translation>
    </message>
    <message>
        <source>Spans</source>
        <translation>Aperture</translation>
    </message>
    <message>
        <source>Finger coordination</source>
        <translation>Coordinazione delle dita</translation>
    </message>
    <message>
        <source>Additional measures</source>
        <translation>Misure aggiuntive</translation>
    </message>
    <message>
        <source>Range of motion of the fingers</source>
        <translation>Escursione articolare delle dita</translation>
    </message>
    <message>
        <source>not visible</source>
        <translation>non visibile</translation>
    </message>
    <message>
        <source>dashed: occluded; hatched: lost</source>
        <translation>tratteggio: nascosto; area a righe: perso</translation>
    </message>
    <message>
        <source>Finger flexion over time</source>
        <translation>Flessione delle dita nel tempo</translation>
    </message>
    <message>
        <source>PIP (thumb: palmar abduction)</source>
        <translation>IFP (pollice: abduzione palmare)</translation>
    </message>
    <message>
        <source>not graded</source>
        <translation>non classificato</translation>
    </message>
    <message>
        <source>excellent</source>
        <translation>ottimo</translation>
    </message>
    <message>
        <source>good</source>
        <translation>buono</translation>
    </message>
    <message>
        <source>fair</source>
        <translation>discreto</translation>
    </message>
    <message>
        <source>poor</source>
        <translation>scarso</translation>
    </message>
    <message>
        <source>Total (TAM)</source>
        <translation>Totale (TAM)</translation>
    </message>
    <message>
        <source>% of other hand</source>
        <translation>% dell’altra mano</translation>
    </message>
    <message>
        <source>% of reference</source>
        <translation>% del riferimento</translation>
    </message>
    <message>
        <source>{what}, {day}</source>
        <translation>{what}, {day}</translation>
    </message>
    <message>
        <source>Change since {day}</source>
        <translation>Rispetto a: {day}</translation>
    </message>
    <message>
        <source>palmar abduction of the thumb</source>
        <translation>abduzione palmare del pollice</translation>
    </message>
    <message>
        <source>MCP of {fingers}</source>
        <translation>MCF di: {fingers}</translation>
    </message>
    <message>
        <source>PIP of {fingers}</source>
        <translation>IFP di: {fingers}</translation>
    </message>
    <message>
        <source>DIP of {fingers}</source>
        <translation>IFD di: {fingers}</translation>
    </message>
    <message>
        <source>all fingers</source>
        <translation>tutte le dita</translation>
    </message>
    <message>
        <source>Not visible: {joints}.</source>
        <translation>Non visibili: {joints}.</translation>
    </message>
    <message>
        <source>Total active motion (TAM): a finger’s largest total flexion minus its smallest, with all joints visible.</source>
        <translation>Movimento attivo totale (TAM): massima somma delle flessioni di un dito meno la minima, con tutte le articolazioni visibili.</translation>
    </message>
    <message>
        <source>No total active motion (TAM): no finger had all joints visible at once.</source>
        <translation>Nessun movimento attivo totale (TAM): nessun dito aveva tutte le articolazioni visibili contemporaneamente.</translation>
    </message>
    <message>
        <source>PIP joints</source>
        <translation>Articolazioni IFP</translation>
    </message>
    <message>
        <source>{what}: {fingers}.</source>
        <translation>{what}: {fingers}.</translation>
    </message>
    <message>
        <source>{sign}: the end of this movement was occluded.</source>
        <translation>{sign}: la fine di questo movimento era nascosta.</translation>
    </message>
    <message>
        <source>the first session on {day}</source>
        <translation>della prima seduta ({day})</translation>
    </message>
    <message>
        <source>Change since {when} is not assessed: {why}.</source>
        <translation>Cambiamento rispetto al giorno {when} non valutato: {why}.</translation>
    </message>
    <message>
        <source>Partly occluded joints are not assessed.</source>
        <translation>Le articolazioni in parte nascoste non sono valutate.</translation>
    </message>
    <message>
        <source>Since {when}: {changes} (MDC {limit}).</source>
        <translation>Rispetto al giorno {when}: {changes} (MDC {limit}).</translation>
    </message>
    <message>
        <source>IP</source>
        <translation>IF</translation>
    </message>
    <message>
        <source>not measured</source>
        <translation>non misurato</translation>
    </message>
    <message>
        <source>not assessed: {why}</source>
        <translation>non valutato: {why}</translation>
    </message>
    <message>
        <source>flexion {full}, deficit {missing}</source>
        <translation>flessione {full}, deficit {missing}</translation>
    </message>
    <message>
        <source>TAM of all fingers</source>
        <translation>TAM di tutte le dita</translation>
    </message>
    <message>
        <source>Palmar and radial abduction of the thumb</source>
        <translation>Abduzione palmare e radiale del pollice</translation>
    </message>
    <message>
        <source>Path of the wrist</source>
        <translation>Percorso del polso</translation>
    </message>
    <message>
        <source>joint centres; dashed: marker occluded</source>
        <translation>centri articolari; tratteggio: marcatore nascosto</translation>
    </message>
    <message>
        <source>Fingertip paths</source>
        <translation>Percorsi dei polpastrelli</translation>
    </message>
    <message>
        <source>X (black) to the fingers, Y (blue) to the thumb, Z (orange) up</source>
        <translation>X (nero) verso le dita, Y (blu) verso il pollice, Z (arancione) in su</translation>
    </message>
    <message>
        <source>X (black) to the fingers, Y (blue) away from the thumb, Z (orange) up</source>
        <translation>X (nero) verso le dita, Y (blu) via dal pollice, Z (arancione) in su</translation>
    </message>
    <message>
        <source>ZYZ angles</source>
        <translation>Angoli ZYZ</translation>
    </message>
    <message>
        <source>Progress report</source>
        <translation>Relazione sull’andamento</translation>
    </message>
    <message>
        <source>Sessions</source>
        <translation>Sedute</translation>
    </message>
    <message>
        <source>First</source>
        <translation>Prima</translation>
    </message>
    <message>
        <source>Last</source>
        <translation>Ultima</translation>
    </message>
    <message>
        <source>Therapist</source>
        <translation>Terapista</translation>
    </message>
    <message>
        <source>1 session: {ids}</source>
        <translation>1 seduta: {ids}</translation>
    </message>
    <message>
        <source>{count} sessions: {ids}</source>
        <translation>{count} sedute: {ids}</translation>
    </message>
    <message>
        <source>{before} and {after} repetitions</source>
        <translation>{before} e {after} ripetizioni</translation>
    </message>
    <message>
        <source>First to last session</source>
        <translation>Dalla prima all’ultima seduta</translation>
    </message>
    <message>
        <source>not combined with the values above</source>
        <translation>non combinati con i valori sopra</translation>
    </message>
    <message>
        <source>Comparability</source>
        <translation>Confrontabilità</translation>
    </message>
    <message>
        <source>All sessions used the same set-up.</source>
        <translation>Tutte le sedute hanno la stessa preparazione.</translation>
    </message>
    <message>
        <source>Session report</source>
        <translation>Relazione della seduta</translation>
    </message>
    <message>
        <source>SIMULATED</source>
        <translation>SIMULATA</translation>
    </message>
    <message>
        <source>active and passive</source>
        <translation>attiva e passiva</translation>
    </message>
    <message>
        <source>right-handed</source>
        <translation>destrimane</translation>
    </message>
    <message>
        <source>left-handed</source>
        <translation>mancino</translation>
    </message>
    <message>
        <source>both-handed</source>
        <translation>ambidestro</translation>
    </message>
    <message>
        <source>Date</source>
        <translation>Data</translation>
    </message>
    <message>
        <source>Session</source>
        <translation>Seduta</translation>
    </message>
    <message>
        <source>Range of motion</source>
        <translation>Escursione articolare</translation>
    </message>
    <message>
        <source>Active and passive</source>
        <translation>Attivo e passivo</translation>
    </message>
    <message>
        <source>dashed: goal</source>
        <translation>tratteggio: obiettivo</translation>
    </message>
    <message>
        <source>Angles over time</source>
        <translation>Angoli nel tempo</translation>
    </message>
    <message>
        <source>Pronation–supination</source>
        <translation>Prono-supinazione</translation>
    </message>
    <message>
        <source>Today</source>
        <translation>Oggi</translation>
    </message>
    <message>
        <source>How reliable are these values?</source>
        <translation>Quanto sono affidabili questi valori?</translation>
    </message>
    <message>
        <source>The therapist’s comment is on the last page.</source>
        <translation>Il commento del terapista è nell’ultima pagina.</translation>
    </message>
    <message>
        <source>Movement measured by camera: {who}</source>
        <translation>Movimento misurato con la telecamera: {who}</translation>
    </message>
    <message>
        <source>Dear colleague,</source>
        <translation>Gentile collega,</translation>
    </message>
    <message>
        <source>On {day} we measured: {exercise}, {hand}. Repetitions analysed: {count}.</source>
        <translation>In data {day} abbiamo misurato: {exercise}, {hand}. Ripetizioni analizzate: {count}.</translation>
    </message>
    <message>
        <source>Kind regards,</source>
        <translation>Cordiali saluti,</translation>
    </message>
    <message>
        <source>Signature</source>
        <translation>Firma</translation>
    </message>
    <message>
        <source>Session {id}</source>
        <translation>Seduta {id}</translation>
    </message>
    <message>
        <source>settings {digest}</source>
        <translation>impostazioni {digest}</translation>
    </message>
    <message>
        <source>data {digest}</source>
        <translation>dati {digest}</translation>
    </message>
    <message>
        <source>recording {digest}</source>
        <translation>registrazione {digest}</translation>
    </message>
    <message>
        <source>smoothed</source>
        <translation>con smoothing</translation>
    </message>
    <message>
        <source>Movement</source>
        <translation>Movimento</translation>
    </message>
    <message>
        <source>Best</source>
        <translation>Migliore</translation>
    </message>
    <message>
        <source>Reference (adults)</source>
        <translation>Riferimento (adulti)</translation>
    </message>
    <message>
        <source>1 repetition</source>
        <translation>1 ripetizione</translation>
    </message>
    <message>
        <source>mean of {count} repetitions</source>
        <translation>media di {count} ripetizioni</translation>
    </message>
    <message>
        <source>no active repetition</source>
        <translation>nessuna ripetizione attiva</translation>
    </message>
    <message>
        <source>plus 1 passive</source>
        <translation>più 1 passiva</translation>
    </message>
    <message>
        <source>plus {count} passive</source>
        <translation>più {count} passive</translation>
    </message>
    <message>
        <source>not visible enough</source>
        <translation>non abbastanza visibile</translation>
    </message>
    <message>
        <source>cut off at the start of the recording</source>
        <translation>tagliata all’inizio della registrazione</translation>
    </message>
    <message>
        <source>the hand left the camera’s view</source>
        <translation>la mano è uscita dall’inquadratura</translation>
    </message>
    <message>
        <source>cut off at the end of the recording</source>
        <translation>tagliata alla fine della registrazione</translation>
    </message>
    <message>
        <source>passive repetitions excluded</source>
        <translation>ripetizioni passive escluse</translation>
    </message>
    <message>
        <source>range over the whole recording; no repetitions</source>
        <translation>escursione sull’intera registrazione; nessuna ripetizione</translation>
    </message>
    <message>
        <source>the exercised joint was not visible</source>
        <translation>l’articolazione esercitata non era visibile</translation>
    </message>
    <message>
        <source>less than 10° of movement</source>
        <translation>meno di 10° di movimento</translation>
    </message>
    <message>
        <source>no complete movement cycle</source>
        <translation>nessun ciclo di movimento completo</translation>
    </message>
    <message>
        <source>{seconds} s occluded and not analysed</source>
        <translation>{seconds} s nascosti e non analizzati</translation>
    </message>
    <message>
        <source>{angle} at most</source>
        <translation>al massimo {angle}</translation>
    </message>
    <message>
        <source>under {angle}</source>
        <translation>sotto {angle}</translation>
    </message>
    <message>
        <source>more than intended: check the exercise technique</source>
        <translation>più del previsto: controllare l’esecuzione</translation>
    </message>
    <message>
        <source>total arc</source>
        <translation>arco totale</translation>
    </message>
    <message>
        <source>{name} improved by {size}</source>
        <translation>{name}: miglioramento di {size}</translation>
    </message>
    <message>
        <source>{name} decreased by {size}</source>
        <translation>{name}: diminuzione di {size}</translation>
    </message>
    <message>
        <source>(MDC {limit})</source>
        <translation>(MDC {limit})</translation>
    </message>
    <message>
        <source>Since {when}: {changes}.</source>
        <translation>Rispetto al giorno {when}: {changes}.</translation>
    </message>
    <message>
        <source>Fingers: 0° = straight; negative = hyperextension. Wrist: {zero}.</source>
        <translation>Dita: 0° = dito esteso; negativo = iperestensione. Polso: {zero}.</translation>
    </message>
    <message>
        <source>Fingers: 0° = straight; negative = hyperextension. TAM = total flexion minus extension deficit. Wrist: {zero}.</source>
        <translation>Dita: 0° = dito esteso; negativo = iperestensione. TAM = flessione totale meno deficit di estensione. Polso: {zero}.</translation>
    </message>
    <message>
        <source>0° set by goniometer, start position {angles}</source>
        <translation>0° fissato con il goniometro, posizione iniziale {angles}</translation>
    </message>
    <message>
        <source>Method: {markers} markers, colour and depth camera, {distance} away.</source>
        <translation>Metodo: {markers} marcatori, telecamera a colori e di profondità, a {distance}.</translation>
    </message>
    <message>
        <source>Angles are relative to the room. They equal wrist angles only while the forearm is still.</source>
        <translation>Gli angoli sono riferiti all’ambiente. Equivalgono agli angoli del polso solo finché l’avambraccio resta fermo.</translation>
    </message>
    <message>
        <source>Camera not calibrated with a board.</source>
        <translation>Telecamera non calibrata con la tavola.</translation>
    </message>
    <message>
        <source>Camera calibrated {day}.</source>
        <translation>Telecamera calibrata: {day}.</translation>
    </message>
    <message>
        <source>Camera calibrated {day}, {days} days before.</source>
        <translation>Telecamera calibrata: {day}, {days} giorni prima.</translation>
    </message>
    <message>
        <source>Simulated data: no patient was measured.</source>
        <translation>Dati simulati: non sono misure di un paziente.</translation>
    </message>
    <message>
        <source>Measured although uncertain: {findings}</source>
        <translation>Misurata nonostante l’incertezza: {findings}</translation>
    </message>
    <message>
        <source>This session is excluded from analysis.</source>
        <translation>Questa seduta è esclusa dall’analisi.</translation>
    </message>
    <message>
        <source>An older result: there is a newer one of the same recording.</source>
        <translation>Risultato precedente: ce n’è uno più recente della stessa registrazione.</translation>
    </message>
    <message>
        <source>This recording was cut short and recovered.</source>
        <translation>Questa registrazione si è interrotta ed è stata recuperata.</translation>
    </message>
    <message>
        <source>Warning</source>
        <translation>Avvertenza</translation>
    </message>
    <message>
        <source>at the top of the page</source>
        <translation>in alto nella pagina</translation>
    </message>
    <message>
        <source>Corrected on {day}, from {time}, by {who}.</source>
        <translation>Corretta in data {day} da {who}, a partire da {time}.</translation>
    </message>
    <message>
        <source>Corrected on {day}, from {time}.</source>
        <translation>Corretta in data {day}, a partire da {time}.</translation>
    </message>
    <message>
        <source>{share} % of the time</source>
        <translation>{share} % del tempo</translation>
    </message>
    <message>
        <source>Frames measured</source>
        <translation>Fotogrammi misurati</translation>
    </message>
    <message>
        <source>Markers occluded</source>
        <translation>Marcatori nascosti</translation>
    </message>
    <message>
        <source>{count} of {all} values</source>
        <translation>{count} valori su {all}</translation>
    </message>
    <message>
        <source>Minimum (≥) or not visible</source>
        <translation>Minimo (≥) o non visibile</translation>
    </message>
    <message>
        <source>{distance} (limit {limit})</source>
        <translation>{distance} (limite {limit})</translation>
    </message>
    <message>
        <source>Wrist rotation centre</source>
        <translation>Centro di rotazione del polso</translation>
    </message>
    <message>
        <source>{angle} at most (limit {limit})</source>
        <translation>al massimo {angle} (limite {limit})</translation>
    </message>
    <message>
        <source>Smoothness (SPARC; closer to 0 is smoother)</source>
        <translation>Fluidità (SPARC; più vicino a 0 è migliore)</translation>
    </message>
    <message>
        <source>Goal</source>
        <translation>Obiettivo</translation>
    </message>
    <message>
        <source>Pain first / last (0–10)</source>
        <translation>Dolore iniziale / finale (0–10)</translation>
    </message>
    <message>
        <source>Pain (0–10)</source>
        <translation>Dolore (0–10)</translation>
    </message>
    <message>
        <source>not asked</source>
        <translation>non chiesto</translation>
    </message>
    <message>
        <source>{pain} at {time}</source>
        <translation>{pain} a {time}</translation>
    </message>
    <message>
        <source>Values of a simulated hand are never used.</source>
        <translation>I valori di una mano simulata non vengono mai usati.</translation>
    </message>
    <message>
        <source>Not usable yet: at least {count} people are needed, 20 are better.</source>
        <translation>Non ancora utilizzabile: servono almeno {count} persone, meglio 20.</translation>
    </message>
    <message>
        <source>Excluded: {sessions}.</source>
        <translation>Escluse: {sessions}.</translation>
    </message>
    <message>
        <source>more than 14 days later</source>
        <translation>dopo più di 14 giorni</translation>
    </message>
    <message>
        <source>missing</source>
        <translation>manca</translation>
    </message>
    <message>
        <source>cannot be read</source>
        <translation>non si può leggere</translation>
    </message>
    <message>
        <source>Measured by this clinic: {exercise}</source>
        <translation>Misurato da questo centro: {exercise}</translation>
    </message>
    <message>
        <source>SEM {size}</source>
        <translation>SEM {size}</translation>
    </message>
    <message>
        <source>Flexion, extension</source>
        <translation>Flessione, estensione</translation>
    </message>
    <message>
        <source>Radial, ulnar deviation</source>
        <translation>Deviazione radiale, ulnare</translation>
    </message>
    <message>
        <source>Supination, pronation</source>
        <translation>Supinazione, pronazione</translation>
    </message>
    <message>
        <source>{exercise}, {count} times</source>
        <translation>{exercise}, {count} volte</translation>
    </message>
    <message>
        <source>{exercise}, {count} s</source>
        <translation>{exercise}, {count} s</translation>
    </message>
    <message>
        <source>Wrist flexion–extension</source>
        <translation>Flesso-estensione del polso</translation>
    </message>
    <message>
        <source>Free movement</source>
        <translation>Movimento libero</translation>
    </message>
    <message>
        <source>Full fist</source>
        <translation>Pugno completo</translation>
    </message>
    <message>
        <source>Hook fist</source>
        <translation>Pugno a uncino</translation>
    </message>
    <message>
        <source>Spread the fingers</source>
        <translation>Divaricare le dita</translation>
    </message>
    <message>
        <source>Thumb opposition</source>
        <translation>Opposizione del pollice</translation>
    </message>
    <message>
        <source>Free movement of the fingers</source>
        <translation>Movimento libero delle dita</translation>
    </message>
    <message>
        <source>Whole hand · {count} markers</source>
        <translation>Mano intera · {count} marcatori</translation>
    </message>
    <message>
        <source>Some fingers · {count} markers</source>
        <translation>Alcune dita · {count} marcatori</translation>
    </message>
    <message>
        <source>Wrist · {count} markers</source>
        <translation>Polso · {count} marcatori</translation>
    </message>
    <message>
        <source>operated on {day}</source>
        <translation>intervento in data {day}</translation>
    </message>
    <message>
        <source>injured on {day}</source>
        <translation>lesione in data {day}</translation>
    </message>
    <message>
        <source>Turn the palm up as far as the markers stay visible, then back.</source>
        <translation>Girare il palmo in su finché i marcatori restano visibili, poi tornare.</translation>
    </message>
    <message>
        <source>Move the wrist freely. All three angles are recorded; no repetitions are counted.</source>
        <translation>Muovere il polso liberamente. Si registrano tutti e tre gli angoli; le ripetizioni non si contano.</translation>
    </message>
    <message>
        <source>Close all fingers into a full fist, then open flat.</source>
        <translation>Chiudere tutte le dita in un pugno completo, poi aprire la mano.</translation>
    </message>
    <message>
        <source>Spread the fingers wide, then close them.</source>
        <translation>Divaricare bene le dita, poi chiuderle.</translation>
    </message>
    <message>
        <source>Touch each fingertip with the thumb in turn. Abduct the thumb fully in between.</source>
        <translation>Toccare con il pollice la punta di un dito dopo l’altro, abducendolo del tutto ogni volta.</translation>
    </message>
    <message>
        <source>Reach, take the cup, lift it a little, put it back, return.</source>
        <translation>Raggiungere e prendere il bicchiere, sollevarlo un poco, posarlo, tornare.</translation>
    </message>
    <message>
        <source>Move the fingers freely. All joint angles are recorded; no repetitions are counted.</source>
        <translation>Muovere le dita liberamente. Si registrano tutti gli angoli articolari; le ripetizioni non si contano.</translation>
    </message>
    <message>
        <source>Forearm on a 10 cm wedge, palm down, hand over the edge, fingers relaxed.</source>
        <translation>Avambraccio su un cuneo di 10 cm, palmo in giù, mano oltre il bordo, dita rilassate.</translation>
    </message>
    <message>
        <source>Palm flat on a smooth sheet, forearm strapped.</source>
        <translation>Palmo piatto su un foglio liscio, avambraccio fissato.</translation>
    </message>
    <message>
        <source>Elbow at the side, forearm free, palm down under the camera.</source>
        <translation>Gomito al fianco, avambraccio libero, palmo in giù sotto la telecamera.</translation>
    </message>
    <message>
        <source>Hand in view of the camera, back of the hand up.</source>
        <translation>Mano davanti alla telecamera, dorso in su.</translation>
    </message>
    <message>
        <source>Forearm on the wedge, back of the hand towards the camera, fingers straight.</source>
        <translation>Avambraccio sul cuneo, dorso della mano verso la telecamera, dita estese.</translation>
    </message>
    <message>
        <source>Palm flat on the table, fingers straight and closed.</source>
        <translation>Palmo piatto sul tavolo, dita estese e chiuse.</translation>
    </message>
    <message>
        <source>Forearm on the wedge, thumb side turned up a little, fingers relaxed.</source>
        <translation>Avambraccio sul cuneo, lato del pollice un poco in su, dita rilassate.</translation>
    </message>
    <message>
        <source>Hand in view of the camera, back of the hand up, fingers straight.</source>
        <translation>Mano davanti alla telecamera, dorso in su, dita estese.</translation>
    </message>
    <message>
        <source>Legal notice, in its English wording:</source>
        <translation>Avvertenza legale, nel testo inglese:</translation>
    </message>
    <message>
        <source>Radial</source>
        <translation>Radiale</translation>
    </message>
    <message>
        <source>Ulnar</source>
        <translation>Ulnare</translation>
    </message>
    <message>
        <source>Extension</source>
        <translation>Estensione</translation>
    </message>
    <message>
        <source>Supination</source>
        <translation>Supinazione</translation>
    </message>
    <message>
        <source>Pronation</source>
        <translation>Pronazione</translation>
    </message>
    <message>
        <source>Radial deviation deficit</source>
        <translation>Deficit di deviazione radiale</translation>
    </message>
    <message>
        <source>Ulnar deviation deficit</source>
        <translation>Deficit di deviazione ulnare</translation>
    </message>
    <message>
        <source>Flexion deficit</source>
        <translation>Deficit di flessione</translation>
    </message>
    <message>
        <source>Extension deficit</source>
        <translation>Deficit di estensione</translation>
    </message>
    <message>
        <source>Supination deficit</source>
        <translation>Deficit di supinazione</translation>
    </message>
    <message>
        <source>Pronation deficit</source>
        <translation>Deficit di pronazione</translation>
    </message>
    <message>
        <source>{angle} deficit</source>
        <translation>deficit {angle}</translation>
    </message>
    <message>
        <source>Radial deviation</source>
        <translation>Deviazione radiale</translation>
    </message>
    <message>
        <source>Ulnar deviation</source>
        <translation>Deviazione ulnare</translation>
    </message>
    <message>
        <source>Right hand</source>
        <translation>Mano destra</translation>
    </message>
    <message>
        <source>Left hand</source>
        <translation>Mano sinistra</translation>
    </message>
    <message>
        <source>Both hands</source>
        <translation>Entrambe le mani</translation>
    </message>
    <message>
        <source>Right</source>
        <translation>Destra</translation>
    </message>
    <message>
        <source>Left</source>
        <translation>Sinistra</translation>
    </message>
    <message>
        <source>Both</source>
        <translation>Entrambe</translation>
    </message>
    <message>
        <source>Right hand affected</source>
        <translation>Mano destra colpita</translation>
    </message>
    <message>
        <source>Left hand affected</source>
        <translation>Mano sinistra colpita</translation>
    </message>
    <message>
        <source>Both hands affected</source>
        <translation>Entrambe le mani colpite</translation>
    </message>
    <message>
        <source>Choose the image source, then continue here.</source>
        <translation>Scegliere la sorgente delle immagini, poi proseguire qui.</translation>
    </message>
    <message>
        <source>Take the image when the hand lies flat and every marker is visible.</source>
        <translation>Acquisire l’immagine quando la mano è piatta e tutti i marcatori sono visibili.</translation>
    </message>
    <message>
        <source>The joints are already tracked. The space bar starts the recording.</source>
        <translation>Le articolazioni sono già rilevate. La barra spaziatrice avvia la registrazione.</translation>
    </message>
    <message>
        <source>Let the hand move a few times. Then press the space bar to stop and save.</source>
        <translation>Far muovere la mano alcune volte. Poi premere la barra spaziatrice per terminare e salvare.</translation>
    </message>
    <message>
        <source>These are the results. The key X excludes the current repetition.</source>
        <translation>Questi sono i risultati. Il tasto X esclude la ripetizione corrente.</translation>
    </message>
    <message>
        <source>Make the report of this session here.</source>
        <translation>Qui si crea la relazione di questa seduta.</translation>
    </message>
    <message>
        <source>the other hand</source>
        <translation>l’altra mano</translation>
    </message>
    <message>
        <source>other markers</source>
        <translation>altri marcatori</translation>
    </message>
    <message>
        <source>another exercise</source>
        <translation>un altro esercizio</translation>
    </message>
    <message>
        <source>fewer than 3 repetitions</source>
        <translation>meno di 3 ripetizioni</translation>
    </message>
    <message>
        <source>a simulated hand</source>
        <translation>una mano simulata</translation>
    </message>
    <message>
        <source>excluded from analysis</source>
        <translation>esclusa dall’analisi</translation>
    </message>
    <message>
        <source>measured although the markers were uncertain</source>
        <translation>misurata con marcatori incerti</translation>
    </message>
    <message>
        <source>the camera was at another distance</source>
        <translation>la telecamera era a un’altra distanza</translation>
    </message>
    <message>
        <source>another start angle was given</source>
        <translation>era indicata un’altra posizione iniziale</translation>
    </message>
    <message>
        <source>the forearm moved</source>
        <translation>l’avambraccio si è spostato</translation>
    </message>
    <message>
        <source>angles in another order</source>
        <translation>angoli in un altro ordine</translation>
    </message>
    <message>
        <source>Only the newest result of a recording is analysed: 1 earlier result is excluded.</source>
        <translation>Di ogni registrazione si analizza solo il risultato più recente: 1 precedente è escluso.</translation>
    </message>
    <message>
        <source>Only the newest result of a recording is analysed: {count} earlier results are excluded.</source>
        <translation>Di ogni registrazione si analizza solo il risultato più recente: {count} precedenti sono esclusi.</translation>
    </message>
    <message>
        <source>{size} more</source>
        <translation>{size} in più</translation>
    </message>
    <message>
        <source>{size} less</source>
        <translation>{size} in meno</translation>
    </message>
    <message>
        <source>{difference}, within MDC ({limit})</source>
        <translation>{difference}, entro l’MDC ({limit})</translation>
    </message>
    <message>
        <source>{difference}, beyond MDC ({limit})</source>
        <translation>{difference}, oltre l’MDC ({limit})</translation>
    </message>
    <message>
        <source>Another blue spot is close to the {markers}: it may be the marker.</source>
        <translation>Un altro punto blu è molto vicino a: {markers}. Potrebbe essere il marcatore.</translation>
    </message>
    <message>
        <source>As root, write into {file}: {rule}. Run: udevadm control --reload. Then plug the camera in again.</source>
        <translation>Come root, scrivere in {file}: {rule}. Eseguire: udevadm control --reload. Poi ricollegare la telecamera.</translation>
    </message>
    <message>
        <source>Update the firmware with the manufacturer’s RealSense Viewer.</source>
        <translation>Aggiornare il firmware con RealSense Viewer del produttore.</translation>
    </message>
    <message>
        <source>Carpus cannot write to {subject} ({detail}).</source>
        <translation>Carpus non può scrivere in {subject} ({detail}).</translation>
    </message>
    <message>
        <source>Check that a marker was clicked there, and not another blue spot.</source>
        <translation>Controllare che il clic sia su un marcatore, e non su un altro punto blu.</translation>
    </message>
    <message>
        <source>Check that every marker is clicked under its own label.</source>
        <translation>Controllare che ogni marcatore sia indicato con la sua etichetta.</translation>
    </message>
    <message>
        <source>Check the name and the folder.</source>
        <translation>Controllare il nome e la cartella.</translation>
    </message>
    <message>
        <source>Check the patient, the side, and that every marker is clicked under its own label.</source>
        <translation>Controllare il paziente, il lato, e che ogni marcatore sia indicato con la sua etichetta.</translation>
    </message>
    <message>
        <source>Choose a folder on another disk.</source>
        <translation>Scegliere una cartella su un altro disco.</translation>
    </message>
    <message>
        <source>Choose another name.</source>
        <translation>Scegliere un altro nome.</translation>
    </message>
    <message>
        <source>Choose another recording, or record again.</source>
        <translation>Scegliere un’altra registrazione, o registrare di nuovo.</translation>
    </message>
    <message>
        <source>Choose the other side, or click the markers again.</source>
        <translation>Scegliere l’altro lato, o fare di nuovo clic sui marcatori.</translation>
    </message>
    <message>
        <source>Click all markers again, each under its own label.</source>
        <translation>Fare di nuovo clic su tutti i marcatori, ognuno con la sua etichetta.</translation>
    </message>
    <message>
        <source>Click each of the two on its own marker.</source>
        <translation>Fare di nuovo clic, per ciascuna delle due etichette, sul proprio marcatore.</translation>
    </message>
    <message>
        <source>Click nearer to the marker, or check the light.</source>
        <translation>Fare clic più vicino al marcatore, o controllare la luce.</translation>
    </message>
    <message>
        <source>Clock</source>
        <translation>Orologio</translation>
    </message>
    <message>
        <source>Close the other program that uses the camera.</source>
        <translation>Chiudere l’altro programma che usa la telecamera.</translation>
    </message>
    <message>
        <source>Close the other program, then try again.</source>
        <translation>Chiudere l’altro programma, poi riprovare.</translation>
    </message>
    <message>
        <source>Data folder</source>
        <translation>Cartella dei dati</translation>
    </message>
    <message>
        <source>Depth and colour are not aligned at the {markers} ({value} {unit}, up to {limit} is good).</source>
        <translation>Profondità e colore non sono allineati qui: {markers} ({value} {unit}, fino a {limit} va bene).</translation>
    </message>
    <message>
        <source>Disk</source>
        <translation>Disco</translation>
    </message>
    <message>
        <source>Driver</source>
        <translation>Driver</translation>
    </message>
    <message>
        <source>Firmware</source>
        <translation>Firmware</translation>
    </message>
    <message>
        <source>Fist, hook, spread</source>
        <translation>Pugno, uncino, divaricazione</translation>
    </message>
    <message>
        <source>Fonts</source>
        <translation>Caratteri</translation>
    </message>
    <message>
        <source>Free space on the disk of {folder}.</source>
        <translation>Liberare spazio sul disco di {folder}.</translation>
    </message>
    <message>
        <source>Allow writing there, or choose another folder in the settings.</source>
        <translation>Permettere la scrittura in questa cartella, o sceglierne un’altra nelle impostazioni.</translation>
    </message>
    <message>
        <source>Install Carpus again: part of it is missing.</source>
        <translation>Installare di nuovo Carpus: ne manca una parte.</translation>
    </message>
    <message>
        <source>Install OpenNI2 from the camera’s manufacturer, then restart Carpus.</source>
        <translation>Installare OpenNI2 del produttore della telecamera, poi riavviare Carpus.</translation>
    </message>
    <message>
        <source>Install the packages that contain these libraries.</source>
        <translation>Installare i pacchetti che contengono queste librerie.</translation>
    </message>
    <message>
        <source>Keep the hand still and take the first image again.</source>
        <translation>Tenere ferma la mano e rifare la prima immagine.</translation>
    </message>
    <message>
        <source>Keep the hand still for half a second.</source>
        <translation>Tenere ferma la mano per mezzo secondo.</translation>
    </message>
    <message>
        <source>Check the lines on the image, and give the marker its correct label.</source>
        <translation>Controllare le linee nell’immagine, e dare al marcatore l’etichetta giusta.</translation>
    </message>
    <message>
        <source>Mirror</source>
        <translation>Specchio</translation>
    </message>
    <message>
        <source>Move the hand a little, and keep sunlight and reflections off the marker.</source>
        <translation>Spostare un poco la mano, e tenere sole e riflessi lontani dal marcatore.</translation>
    </message>
    <message>
        <source>Needed for live cameras. {remedy}</source>
        <translation>Serve per misurare dal vivo con le telecamere. {remedy}</translation>
    </message>
    <message>
        <source>No blue marker at the {markers}.</source>
        <translation>Nessun marcatore blu in questo punto: {markers}.</translation>
    </message>
    <message>
        <source>Not all files could be deleted yet ({detail} left, such as {subject}).</source>
        <translation>Non è stato ancora possibile eliminare tutti i file (ne restano {detail}, per esempio {subject}).</translation>
    </message>
    <message>
        <source>OpenNI2</source>
        <translation>OpenNI2</translation>
    </message>
    <message>
        <source>OpenNI2 stops when its version is queried</source>
        <translation>OpenNI2 si chiude quando si chiede la versione</translation>
    </message>
    <message>
        <source>OpenNI2 {value}</source>
        <translation>OpenNI2 {value}</translation>
    </message>
    <message>
        <source>Orbbec driver</source>
        <translation>Driver Orbbec</translation>
    </message>
    <message>
        <source>Others on this computer can read it. In its properties, remove all rights of the group and of others, or run: chmod 700 &apos;{folder}&apos;</source>
        <translation>Altri su questo computer possono leggerla. Nelle sue proprietà togliere ogni diritto al gruppo e agli altri, oppure eseguire: chmod 700 &apos;{folder}&apos;</translation>
    </message>
    <message>
        <source>Packages</source>
        <translation>Pacchetti</translation>
    </message>
    <message>
        <source>Plug in the camera named in the settings, or change the settings.</source>
        <translation>Collegare la telecamera nominata nelle impostazioni, o cambiare le impostazioni.</translation>
    </message>
    <message>
        <source>Plug it into a USB 3 port, with a USB 3 cable and without a hub.</source>
        <translation>Collegarla a una porta USB 3, con un cavo USB 3 e senza hub.</translation>
    </message>
    <message>
        <source>Plug the camera in again, into another port, without a hub.</source>
        <translation>Ricollegare la telecamera, a un’altra porta, senza hub.</translation>
    </message>
    <message>
        <source>Plug the camera in again. If this persists, times and speeds of this camera are not reliable.</source>
        <translation>Ricollegare la telecamera. Se il problema resta, tempi e velocità di questa telecamera non sono affidabili.</translation>
    </message>
    <message>
        <source>Plug the camera in, preferably directly into the computer. {port}</source>
        <translation>Collegare la telecamera, meglio se direttamente al computer. {port}</translation>
    </message>
    <message>
        <source>Plug the camera in.</source>
        <translation>Collegare la telecamera.</translation>
    </message>
    <message>
        <source>Python</source>
        <translation>Python</translation>
    </message>
    <message>
        <source>Qt {qt}, which stops the program on Python 3.11</source>
        <translation>Qt {qt}, che arresta il programma con Python 3.11</translation>
    </message>
    <message>
        <source>Qt {qt}; no screen</source>
        <translation>Qt {qt}; nessuno schermo</translation>
    </message>
    <message>
        <source>RealSense driver</source>
        <translation>Driver RealSense</translation>
    </message>
    <message>
        <source>Run “{command}”.</source>
        <translation>Eseguire “{command}”.</translation>
    </message>
    <message>
        <source>Run: installer/setup.sh run. Or: install the packages that contain these libraries.</source>
        <translation>Eseguire: installer/setup.sh run. Oppure: installare i pacchetti che contengono queste librerie.</translation>
    </message>
    <message>
        <source>Run: sudo apt-get install libopenni2-0</source>
        <translation>Eseguire: sudo apt-get install libopenni2-0</translation>
    </message>
    <message>
        <source>Swap the two labels, or click both markers again.</source>
        <translation>Scambiare le due etichette, o fare di nuovo clic sui due marcatori.</translation>
    </message>
    <message>
        <source>Turn on depth registration in the camera settings, or track without depth.</source>
        <translation>Attivare l’allineamento profondità-colore nelle impostazioni della telecamera, o analizzare senza profondità.</translation>
    </message>
    <message>
        <source>Choose the spot with the question mark, if it is the marker.</source>
        <translation>Scegliere il punto con il punto interrogativo, se è il marcatore.</translation>
    </message>
    <message>
        <source>The PIN cannot be checked: {subject} is missing on this computer ({detail}).</source>
        <translation>Il PIN non può essere verificato: {subject} manca su questo computer ({detail}).</translation>
    </message>
    <message>
        <source>1. Print both pages at 100 % on plain white paper. Check the rulers: 100 mm.</source>
        <translation>1. Stampare le due pagine al 100 % su carta bianca comune. Verificare i righelli: 100 mm.</translation>
    </message>
    <message>
        <source>2. Glue this page flat on stiff card. Fold the wedge and glue it onto the dashed field.</source>
        <translation>2. Incollare questa pagina su cartone rigido. Piegare il cuneo e incollarlo sul campo tratteggiato.</translation>
    </message>
    <message>
        <source>3. Lay it flat under the camera, about 60 cm away, and run the check for 30 seconds.</source>
        <translation>3. Metterlo piatto sotto la telecamera, a circa 60 cm, e avviare il controllo per 30 secondi.</translation>
    </message>
    <message>
        <source>Carpus camera board: {name}. Glue it flat on a stiff board. Squares: {square}.</source>
        <translation>Tavola di calibrazione Carpus: {name}. Incollarla ben piana su un supporto rigido. Quadrati: {square}.</translation>
    </message>
    <message>
        <source>Carpus check card</source>
        <translation>Cartoncino di controllo di Carpus</translation>
    </message>
    <message>
        <source>Install Carpus again.</source>
        <translation>Installare di nuovo Carpus.</translation>
    </message>
    <message>
        <source>Install the package {package}, which is next to the Carpus package.</source>
        <translation>Installare il pacchetto {package}, che si trova accanto a quello di Carpus.</translation>
    </message>
    <message>
        <source>Camera out of tolerance: {what} (limits: {most_angle}°, {most_length} mm, all lengths {most_share} %).</source>
        <translation>Telecamera fuori tolleranza: {what} (limiti: {most_angle}°, {most_length} mm, tutte le lunghezze {most_share} %).</translation>
    </message>
    <message>
        <source>The clicks for the {markers} are on one marker.</source>
        <translation>I clic sono sullo stesso marcatore: {markers}.</translation>
    </message>
    <message>
        <source>The corners do not fit a flat board: {subject} ({detail}).</source>
        <translation>Gli angoli non corrispondono a una tavola piana: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The file was not changed.</source>
        <translation>Il file non è stato modificato.</translation>
    </message>
    <message>
        <source>The hand is tilted {value}° to the camera (up to {limit}° is good).</source>
        <translation>La mano è inclinata di {value}° rispetto alla telecamera (fino a {limit}° va bene).</translation>
    </message>
    <message>
        <source>The hand is {value} m from the camera ({limit} m or more is good).</source>
        <translation>La mano è a {value} m dalla telecamera ({limit} m o più va bene).</translation>
    </message>
    <message>
        <source>The hand moved in the first half second.</source>
        <translation>La mano si è mossa nel primo mezzo secondo.</translation>
    </message>
    <message>
        <source>The {markers} marker is {value} mm from its expected position (up to {limit} mm is good).</source>
        <translation>Marcatore a {value} mm dalla posizione attesa: {markers} (fino a {limit} mm va bene).</translation>
    </message>
    <message>
        <source>The markers of this session cannot be corrected: {subject} ({detail}).</source>
        <translation>I marcatori di questa seduta non possono essere corretti: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The recording cannot be read: {subject} ({detail}).</source>
        <translation>La registrazione non può essere letta: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The recording has no usable depth: {subject} ({detail}).</source>
        <translation>La registrazione non ha una profondità utilizzabile: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The recording is damaged: {subject} ({detail}).</source>
        <translation>La registrazione è danneggiata: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The recording was not changed.</source>
        <translation>La registrazione non è stata modificata.</translation>
    </message>
    <message>
        <source>The reference cannot be read: {subject} ({detail}).</source>
        <translation>Il riferimento non può essere letto: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The {markers} does not lie on the line of its finger.</source>
        <translation>Marcatore fuori dalla linea del suo dito: {markers}.</translation>
    </message>
    <message>
        <source>There is no folder {subject}.</source>
        <translation>La cartella {subject} non esiste.</translation>
    </message>
    <message>
        <source>There is one more blue spot on the hand than there are labels.</source>
        <translation>Sulla mano c’è un punto blu in più rispetto alle etichette.</translation>
    </message>
    <message>
        <source>This looks like the other hand.</source>
        <translation>Questa sembra l’altra mano.</translation>
    </message>
    <message>
        <source>This port is slow for this camera. {port}</source>
        <translation>Questa porta è troppo lenta per questa telecamera. {port}</translation>
    </message>
    <message>
        <source>This port is too slow. {port}</source>
        <translation>Questa porta è troppo lenta. {port}</translation>
    </message>
    <message>
        <source>This session is not finished: {subject}.</source>
        <translation>Questa seduta non è conclusa: {subject}.</translation>
    </message>
    <message>
        <source>Turn the back of the hand to the camera.</source>
        <translation>Girare il dorso della mano verso la telecamera.</translation>
    </message>
    <message>
        <source>Use another USB port, without a hub or other cameras. Close other demanding programs.</source>
        <translation>Usare un’altra porta USB, senza hub e senza altre telecamere. Chiudere gli altri programmi pesanti.</translation>
    </message>
    <message>
        <source>Wedge: cut along the lines, fold back along the dashes</source>
        <translation>Cuneo: tagliare lungo le linee, piegare indietro lungo i tratteggi</translation>
    </message>
    <message>
        <source>Window</source>
        <translation>Finestra</translation>
    </message>
    <message>
        <source>Wrist, all movements</source>
        <translation>Polso, tutti i movimenti</translation>
    </message>
    <message>
        <source>a folder</source>
        <translation>una cartella</translation>
    </message>
    <message>
        <source>a marker was placed outside the image</source>
        <translation>un marcatore è fuori dall’immagine</translation>
    </message>
    <message>
        <source>a text with an invalid character, in {file}</source>
        <translation>un testo con un carattere non valido, in {file}</translation>
    </message>
    <message>
        <source>an HDF5 file, but not a session</source>
        <translation>un file HDF5, ma non è una seduta</translation>
    </message>
    <message>
        <source>another computer is sending its data</source>
        <translation>un altro computer sta inviando i suoi dati</translation>
    </message>
    <message>
        <source>camera_matrix has {count} numbers, 9 expected</source>
        <translation>camera_matrix ha {count} numeri, attesi 9</translation>
    </message>
    <message>
        <source>camera_matrix is not [fx, 0, cx, 0, fy, cy, 0, 0, 1]</source>
        <translation>camera_matrix non è [fx, 0, cx, 0, fy, cy, 0, 0, 1]</translation>
    </message>
    <message>
        <source>cannot be opened</source>
        <translation>non si può aprire</translation>
    </message>
    <message>
        <source>chessboard {columns} x {rows}, squares of {size} mm</source>
        <translation>scacchiera {columns} x {rows}, quadrati di {size} mm</translation>
    </message>
    <message>
        <source>codec {codec} for {name}</source>
        <translation>codec {codec} per {name}</translation>
    </message>
    <message>
        <source>colour as {name}</source>
        <translation>colore come {name}</translation>
    </message>
    <message>
        <source>colour frame {row}</source>
        <translation>fotogramma a colori {row}</translation>
    </message>
    <message>
        <source>columns</source>
        <translation>colonne</translation>
    </message>
    <message>
        <source>reprojection error {error_px} px, at most {most_px} px accepted</source>
        <translation>errore di riproiezione {error_px} px, massimo accettabile {most_px} px</translation>
    </message>
    <message>
        <source>cropped frames</source>
        <translation>fotogrammi ritagliati</translation>
    </message>
    <message>
        <source>truncated or altered</source>
        <translation>troncato o alterato</translation>
    </message>
    <message>
        <source>damaged</source>
        <translation>danneggiato</translation>
    </message>
    <message>
        <source>damaged, or not C3D</source>
        <translation>danneggiato, o non è C3D</translation>
    </message>
    <message>
        <source>damaged: depth sensor, {cause}</source>
        <translation>danneggiato: sensore di profondità, {cause}</translation>
    </message>
    <message>
        <source>damaged: its content is implausible</source>
        <translation>danneggiato: contenuto non plausibile</translation>
    </message>
    <message>
        <source>damaged: {value}</source>
        <translation>danneggiato: {value}</translation>
    </message>
    <message>
        <source>depth as {name}</source>
        <translation>profondità come {name}</translation>
    </message>
    <message>
        <source>depth and colour are not aligned</source>
        <translation>profondità e colore non sono allineati</translation>
    </message>
    <message>
        <source>depth and colour are aligned, {registered}</source>
        <translation>profondità e colore sono allineati, {registered}</translation>
    </message>
    <message>
        <source>distortion {model} with {count} coefficients</source>
        <translation>distorsione {model} con {count} coefficienti</translation>
    </message>
    <message>
        <source>distortion_coefficients has {count} numbers, {wanted} expected</source>
        <translation>distortion_coefficients ha {count} numeri, attesi {wanted}</translation>
    </message>
    <message>
        <source>distortion_model {said}, {coefficients} expected</source>
        <translation>distortion_model {said}, attesi {coefficients}</translation>
    </message>
    <message>
        <source>empty file</source>
        <translation>file vuoto</translation>
    </message>
    <message>
        <source>foot: glue onto the card</source>
        <translation>base: incollare sul cartoncino</translation>
    </message>
    <message>
        <source>for {width_px} x {height_px} pixels, the frames have {size}</source>
        <translation>per {width_px} x {height_px} pixel, i fotogrammi hanno {size}</translation>
    </message>
    <message>
        <source>over weeks, compared with the measurement error (MDC95)</source>
        <translation>nel corso delle settimane, a confronto con l’errore di misura (MDC95)</translation>
    </message>
    <message>
        <source>fx {fx} and fy {fy} do not fit a frame width of {width} pixels</source>
        <translation>fx {fx} e fy {fy} non sono compatibili con fotogrammi larghi {width} pixel</translation>
    </message>
    <message>
        <source>glue under the low edge</source>
        <translation>incollare sotto il bordo basso</translation>
    </message>
    <message>
        <source>goniometer list</source>
        <translation>elenco del goniometro</translation>
    </message>
    <message>
        <source>hand</source>
        <translation>mano</translation>
    </message>
    <message>
        <source>hand {hand}</source>
        <translation>hand {hand}</translation>
    </message>
    <message>
        <source>in none of the images</source>
        <translation>in nessuna delle immagini</translation>
    </message>
    <message>
        <source>inside the data folder, or containing it</source>
        <translation>è dentro la cartella dei dati, o la contiene</translation>
    </message>
    <message>
        <source>index finger</source>
        <translation>indice</translation>
    </message>
    <message>
        <source>index DIP</source>
        <translation>IFD dell’indice</translation>
    </message>
    <message>
        <source>index PIP</source>
        <translation>IFP dell’indice</translation>
    </message>
    <message>
        <source>index MCP</source>
        <translation>MCF dell’indice</translation>
    </message>
    <message>
        <source>index fingertip</source>
        <translation>punta dell’indice</translation>
    </message>
    <message>
        <source>not readable as JSON, so the default limits apply</source>
        <translation>non leggibile come JSON; valgono i limiti predefiniti</translation>
    </message>
    <message>
        <source>no frames</source>
        <translation>nessun fotogramma</translation>
    </message>
    <message>
        <source>no points</source>
        <translation>nessun punto</translation>
    </message>
    <message>
        <source>no points, or no rate stated</source>
        <translation>nessun punto, o frequenza non indicata</translation>
    </message>
    <message>
        <source>no readings</source>
        <translation>nessuna misura</translation>
    </message>
    <message>
        <source>no table</source>
        <translation>nessuna tabella</translation>
    </message>
    <message>
        <source>columns do not match their names</source>
        <translation>le colonne non corrispondono ai nomi</translation>
    </message>
    <message>
        <source>times out of order</source>
        <translation>tempi non crescenti</translation>
    </message>
    <message>
        <source>times span more than a day: damaged, or a clock jumped</source>
        <translation>i tempi coprono più di un giorno: danneggiata, oppure l’orologio ha avuto un salto</translation>
    </message>
    <message>
        <source>unit {unit}</source>
        <translation>unità {unit}</translation>
    </message>
    <message>
        <source>larger than 1 GB</source>
        <translation>più grande di 1 GB</translation>
    </message>
    <message>
        <source>larger than 2 GB</source>
        <translation>più grande di 2 GB</translation>
    </message>
    <message>
        <source>line {number} is not a time and a file name: {content}</source>
        <translation>la riga {number} non contiene un tempo e un nome di file: {content}</translation>
    </message>
    <message>
        <source>line {number}: {time_s} s after {earlier} s</source>
        <translation>riga {number}: {time_s} s dopo {earlier} s</translation>
    </message>
    <message>
        <source>little finger</source>
        <translation>mignolo</translation>
    </message>
    <message>
        <source>little finger DIP</source>
        <translation>IFD del mignolo</translation>
    </message>
    <message>
        <source>little finger PIP</source>
        <translation>IFP del mignolo</translation>
    </message>
    <message>
        <source>little finger MCP</source>
        <translation>MCF del mignolo</translation>
    </message>
    <message>
        <source>little fingertip</source>
        <translation>punta del mignolo</translation>
    </message>
    <message>
        <source>unknown processor type {processor}</source>
        <translation>tipo di processore sconosciuto {processor}</translation>
    </message>
    <message>
        <source>markers</source>
        <translation>marcatori</translation>
    </message>
    <message>
        <source>middle finger</source>
        <translation>medio</translation>
    </message>
    <message>
        <source>middle finger DIP</source>
        <translation>IFD del medio</translation>
    </message>
    <message>
        <source>middle finger PIP</source>
        <translation>IFP del medio</translation>
    </message>
    <message>
        <source>middle finger MCP</source>
        <translation>MCF del medio</translation>
    </message>
    <message>
        <source>middle fingertip</source>
        <translation>punta del medio</translation>
    </message>
    <message>
        <source>missing, and there is no default camera for frames of {size}</source>
        <translation>manca, e per fotogrammi di {size} non c’è una telecamera predefinita</translation>
    </message>
    <message>
        <source>missing, {place}</source>
        <translation>manca, {place}</translation>
    </message>
    <message>
        <source>missing: {name}</source>
        <translation>manca: {name}</translation>
    </message>
    <message>
        <source>missing: {package}</source>
        <translation>manca: {package}</translation>
    </message>
    <message>
        <source>more than one camera</source>
        <translation>più di una telecamera</translation>
    </message>
    <message>
        <source>too long for a camera calibration</source>
        <translation>troppo lungo per una calibrazione della telecamera</translation>
    </message>
    <message>
        <source>too long for a file of clicks</source>
        <translation>troppo lungo per un file di clic</translation>
    </message>
    <message>
        <source>not MOT: the header has no end</source>
        <translation>non è MOT: manca la fine dell’intestazione</translation>
    </message>
    <message>
        <source>no answer for {patience_s} s</source>
        <translation>nessuna risposta da {patience_s} s</translation>
    </message>
    <message>
        <source>no attribute {name}</source>
        <translation>manca l’attributo {name}</translation>
    </message>
    <message>
        <source>no colour frames</source>
        <translation>nessun fotogramma a colori</translation>
    </message>
    <message>
        <source>no dataset {path}</source>
        <translation>manca l’insieme di dati {path}</translation>
    </message>
    <message>
        <source>no depth frame within {pairing_limit_s} ms of a colour frame</source>
        <translation>nessun fotogramma di profondità entro {pairing_limit_s} ms da uno a colori</translation>
    </message>
    <message>
        <source>no intrinsics for frames of {size}</source>
        <translation>nessun parametro della telecamera per fotogrammi di {size}</translation>
    </message>
    <message>
        <source>no markers</source>
        <translation>nessun marcatore</translation>
    </message>
    <message>
        <source>no frame in {color_list}</source>
        <translation>nessun fotogramma in {color_list}</translation>
    </message>
    <message>
        <source>no frame in {depth_list}</source>
        <translation>nessun fotogramma in {depth_list}</translation>
    </message>
    <message>
        <source>no usable reading</source>
        <translation>nessuna lettura utilizzabile</translation>
    </message>
    <message>
        <source>no space for another {length} MB</source>
        <translation>non c’è spazio per altri {length} MB</translation>
    </message>
    <message>
        <source>no udev rules for the camera</source>
        <translation>nessuna regola udev per la telecamera</translation>
    </message>
    <message>
        <source>none plugged in</source>
        <translation>nessuna collegata</translation>
    </message>
    <message>
        <source>not JSON</source>
        <translation>non è JSON</translation>
    </message>
    <message>
        <source>not JSON, line {lineno}</source>
        <translation>non è JSON, riga {lineno}</translation>
    </message>
    <message>
        <source>not YAML</source>
        <translation>non è YAML</translation>
    </message>
    <message>
        <source>not a backup</source>
        <translation>non è una copia di sicurezza</translation>
    </message>
    <message>
        <source>not a camera calibration</source>
        <translation>non è una calibrazione della telecamera</translation>
    </message>
    <message>
        <source>not a folder</source>
        <translation>non è una cartella</translation>
    </message>
    <message>
        <source>not an image</source>
        <translation>non è un’immagine</translation>
    </message>
    <message>
        <source>not a raw recording</source>
        <translation>non è una registrazione grezza</translation>
    </message>
    <message>
        <source>not a session file</source>
        <translation>non è un file di seduta</translation>
    </message>
    <message>
        <source>not a text file</source>
        <translation>non è un file di testo</translation>
    </message>
    <message>
        <source>not an .oni file</source>
        <translation>non è un file .oni</translation>
    </message>
    <message>
        <source>not an object with hand, protocol and markers</source>
        <translation>non è un oggetto con hand, protocol e markers</translation>
    </message>
    <message>
        <source>excluded from the group values: {people}, fewer than {fewest} pairs</source>
        <translation>esclusi dai valori di gruppo: {people}, meno di {fewest} coppie</translation>
    </message>
    <message>
        <source>not in the patient list</source>
        <translation>non è nell’elenco dei pazienti</translation>
    </message>
    <message>
        <source>not the part file of a session</source>
        <translation>non è il file parziale di una seduta</translation>
    </message>
    <message>
        <source>off</source>
        <translation>non attivo</translation>
    </message>
    <message>
        <source>paths outside the folder</source>
        <translation>percorsi fuori dalla cartella</translation>
    </message>
    <message>
        <source>print again at 100 % (“actual size”).</source>
        <translation>ristampare al 100 % (“dimensioni effettive”).</translation>
    </message>
    <message>
        <source>ring finger</source>
        <translation>anulare</translation>
    </message>
    <message>
        <source>ring finger DIP</source>
        <translation>IFD dell’anulare</translation>
    </message>
    <message>
        <source>ring finger PIP</source>
        <translation>IFP dell’anulare</translation>
    </message>
    <message>
        <source>ring finger MCP</source>
        <translation>MCF dell’anulare</translation>
    </message>
    <message>
        <source>ring fingertip</source>
        <translation>punta dell’anulare</translation>
    </message>
    <message>
        <source>rows of different length, or not numbers</source>
        <translation>righe di lunghezza diversa, o non numeri</translation>
    </message>
    <message>
        <source>still being recorded</source>
        <translation>ancora in registrazione</translation>
    </message>
    <message>
        <source>the curves are opposite, or the time shift is more than {most} s</source>
        <translation>le curve sono opposte, o lo sfasamento supera {most} s</translation>
    </message>
    <message>
        <source>the curves are opposite, or the time shift is more than {most} s. With the same sign they match best at {later} s ({match})</source>
        <translation>le curve sono opposte, o lo sfasamento supera {most} s. Con lo stesso segno concordano meglio a {later} s ({match})</translation>
    </message>
    <message>
        <source>the file changes while it is read</source>
        <translation>il file cambia mentre viene letto</translation>
    </message>
    <message>
        <source>the session contains no frames</source>
        <translation>la seduta non contiene fotogrammi</translation>
    </message>
    <message>
        <source>file not found</source>
        <translation>file non trovato</translation>
    </message>
    <message>
        <source>to CSV, JSON, C3D, TRC, MOT and BIDS</source>
        <translation>in CSV, JSON, C3D, TRC, MOT e BIDS</translation>
    </message>
    <message>
        <source>{angle} at {time} s: the hand was not still, or not visible</source>
        <translation>{angle} a {time} s: la mano non era ferma, o non era visibile</translation>
    </message>
    <message>
        <source>{angle}: not in the session</source>
        <translation>{angle}: non è nella seduta</translation>
    </message>
    <message>
        <source>{count} faces</source>
        <translation>{count} stili</translation>
    </message>
    <message>
        <source>{count} frames</source>
        <translation>{count} fotogrammi</translation>
    </message>
    <message>
        <source>{firmware}, the library asks for {wanted}</source>
        <translation>{firmware}, la libreria richiede {wanted}</translation>
    </message>
    <message>
        <source>{found}, cannot be loaded: {trouble}</source>
        <translation>{found}, non si può caricare: {trouble}</translation>
    </message>
    <message>
        <source>{free} GB free, about {minutes} minutes with video</source>
        <translation>{free} GB liberi, circa {minutes} minuti con video</translation>
    </message>
    <message>
        <source>{names}</source>
        <translation>{names}</translation>
    </message>
    <message>
        <source>{names} and {count} more</source>
        <translation>{names} e altri {count}</translation>
    </message>
    <message>
        <source>{name} ({vendor}:{product}) at {node}, {speed_mbit} Mbit/s</source>
        <translation>{name} ({vendor}:{product}) in {node}, {speed_mbit} Mbit/s</translation>
    </message>
    <message>
        <source>{remedy} In a dark room the camera slows down: add light.</source>
        <translation>{remedy} In una stanza buia la telecamera rallenta: aggiungere luce.</translation>
    </message>
    <message>
        <source>{text}, in use</source>
        <translation>{text}, in uso</translation>
    </message>
    <message>
        <source>{what} {names}: {why}</source>
        <translation>{what} {names}: {why}</translation>
    </message>
    <message>
        <source>{width}x{height}, {fps} fps, {missing} missing, depth in {with_depth} of {count}</source>
        <translation>{width}x{height}, {fps} fps, {missing} mancanti, profondità in {with_depth} su {count}</translation>
    </message>
    <message>
        <source>± is the SD between repetitions.</source>
        <translation>± è la DS fra le ripetizioni.</translation>
    </message>
    <message>
        <source>thumb</source>
        <translation>pollice</translation>
    </message>
    <message>
        <source>thumb CMC</source>
        <translation>CMC del pollice</translation>
    </message>
    <message>
        <source>thumb IP</source>
        <translation>IF del pollice</translation>
    </message>
    <message>
        <source>thumb MCP</source>
        <translation>MCF del pollice</translation>
    </message>
    <message>
        <source>thumb tip</source>
        <translation>punta del pollice</translation>
    </message>
    <message>
        <source>wrist</source>
        <translation>polso</translation>
    </message>
    <message>
        <source>{angle}: the reference moves {percent} % as far as Carpus. It may have another unit or be another angle</source>
        <translation>{angle}: movimento del riferimento rispetto a Carpus: {percent} %. Forse ha un’altra unità o indica un altro angolo</translation>
    </message>
    <message>
        <source>{calibration} has an impossible depth</source>
        <translation>{calibration} ha una profondità impossibile</translation>
    </message>
    <message>
        <source>{calibration} is not in the format of Carpus</source>
        <translation>{calibration} non è nel formato di Carpus</translation>
    </message>
    <message>
        <source>{cause} appears twice</source>
        <translation>{cause} compare due volte</translation>
    </message>
    <message>
        <source>{count} files</source>
        <translation>{count} file</translation>
    </message>
    <message>
        <source>{detail}; {count} rows read</source>
        <translation>{detail}; {count} righe lette</translation>
    </message>
    <message>
        <source>{free} MB free, {least_free_bytes} MB are needed</source>
        <translation>{free} MB liberi, ne servono {least_free_bytes}</translation>
    </message>
    <message>
        <source>{key} has no data</source>
        <translation>{key} non ha dati</translation>
    </message>
    <message>
        <source>{key} contains a value that is not a number</source>
        <translation>{key} contiene un valore che non è un numero</translation>
    </message>
    <message>
        <source>{key} is neither true nor false</source>
        <translation>{key} non è né vero né falso</translation>
    </message>
    <message>
        <source>{key} is not a number of pixels</source>
        <translation>{key} non è un numero di pixel</translation>
    </message>
    <message>
        <source>{lost} of {count} frames</source>
        <translation>{lost} fotogrammi su {count}</translation>
    </message>
    <message>
        <source>{name} changes within the file</source>
        <translation>{name} cambia all’interno del file</translation>
    </message>
    <message>
        <source>{np} frames missing</source>
        <translation>mancano {np} fotogrammi</translation>
    </message>
    <message>
        <source>{one} and {other}</source>
        <translation>{one} e {other}</translation>
    </message>
    <message>
        <source>{one}; {other}</source>
        <translation>{one}; {other}</translation>
    </message>
    <message>
        <source>{shape} x {shape2} pixels, {width} x {height} before</source>
        <translation>{shape} x {shape2} pixel, prima {width} x {height}</translation>
    </message>
    <message>
        <source>{timestamp_s} s after {last_time_s} s</source>
        <translation>{timestamp_s} s dopo {last_time_s} s</translation>
    </message>
    <message>
        <source>{u}, {v} in a frame of {width_px} x {height_px} pixels</source>
        <translation>{u}, {v} in un fotogramma di {width_px} x {height_px} pixel</translation>
    </message>
    <message>
        <source>{value} is not a possible number, in {file}</source>
        <translation>{value} non è un valore ammesso (in {file})</translation>
    </message>
    <message>
        <source>{value} frame {number}</source>
        <translation>{value}, fotogramma {number}</translation>
    </message>
    <message>
        <source>{what}, at byte {position}</source>
        <translation>{what}, al byte {position}</translation>
    </message>
    <message>
        <source>Re&amp;view it</source>
        <translation>R&amp;ivedila</translation>
    </message>
    <message>
        <source>I have read it</source>
        <translation>L’ho letto</translation>
    </message>
    <message>
        <source>words that lose their capital inside a sentence: *</source>
        <translation>parole che perdono la maiuscola dentro una frase: *</translation>
    </message>
    <message>
        <source>page {number} of {count}</source>
        <translation>pagina {number} di {count}</translation>
    </message>
    <message>
        <source>Flexion {flexion}, extension {extension}.</source>
        <translation>Flessione {flexion}, estensione {extension}.</translation>
    </message>
    <message>
        <source>The total arc is {arc}. {change}</source>
        <translation>L’arco totale è {arc}. {change}</translation>
    </message>
    <message>
        <source>Splint as before; exercises at home three times a day.</source>
        <translation>Tutore come prima; esercizi a casa tre volte al giorno.</translation>
    </message>
    <message>
        <source>Reassess in two weeks.</source>
        <translation>Rivalutare tra due settimane.</translation>
    </message>
    <message>
        <source>Practice patient</source>
        <translation>Paziente di prova</translation>
    </message>
    <message>
        <source>There is no session in {subject}.</source>
        <translation>In {subject} non ci sono sedute.</translation>
    </message>
    <message>
        <source>did you mean “{meant}”? There are: {names}</source>
        <translation>forse “{meant}”? Ci sono: {names}</translation>
    </message>
    <message>
        <source>distortion_coefficients do not describe a lens: they cannot be inverted</source>
        <translation>distortion_coefficients non descrive un obiettivo: non è invertibile</translation>
    </message>
    <message>
        <source>damaged header, {count} frames present</source>
        <translation>intestazione danneggiata, {count} fotogrammi presenti</translation>
    </message>
    <message>
        <source>there are none yet</source>
        <translation>non ce ne sono ancora</translation>
    </message>
    <message>
        <source>there are: {names}</source>
        <translation>ci sono: {names}</translation>
    </message>
    <message>
        <source>Ask your IT support. {how}</source>
        <translation>Chiedere al supporto informatico. {how}</translation>
    </message>
    <message>
        <source>Disk encryption</source>
        <translation>Cifratura del disco</translation>
    </message>
    <message>
        <source>Linux encrypts a disk when it is set up (LUKS). Choose this when the system is installed, or move the data folder to an encrypted disk. Do not keep the passphrase with this computer.</source>
        <translation>Linux cifra un disco quando viene preparato (LUKS). Sceglierlo all’installazione del sistema, o spostare la cartella dei dati su un disco cifrato. Non conservare la passphrase con questo computer.</translation>
    </message>
    <message>
        <source>Turn it on in Windows: Settings → Privacy and security → Device encryption, or BitLocker in the Control Panel. Do not keep the recovery key with this computer.</source>
        <translation>Si attiva in Windows: Impostazioni → Privacy e sicurezza → Crittografia del dispositivo, o BitLocker nel Pannello di controllo. Non conservare la chiave di ripristino con questo computer.</translation>
    </message>
    <message>
        <source>The disk of the data folder is encrypted by the system.</source>
        <translation>Il disco della cartella dei dati è cifrato dal sistema.</translation>
    </message>
    <message>
        <source>The disk of the data folder is not encrypted.</source>
        <translation>Il disco della cartella dei dati non è cifrato.</translation>
    </message>
    <message>
        <source>It is not known whether the disk of the data folder is encrypted.</source>
        <translation>Non si sa se il disco della cartella dei dati sia cifrato.</translation>
    </message>
    <message>
        <source>Labels are correct</source>
        <translation>Etichette giuste</translation>
    </message>
    <message>
        <source>Drag a label to another marker to change it.</source>
        <translation>Per cambiare un’etichetta, trascinarla su un altro marcatore.</translation>
    </message>
    <message>
        <source>Measure</source>
        <translation>Misura</translation>
    </message>
    <message>
        <source>Progress</source>
        <translation>Andamento</translation>
    </message>
    <message>
        <source>Review</source>
        <translation>Revisione</translation>
    </message>
    <message>
        <source>a session or the progress as a PDF in English, German or Italian</source>
        <translation>una seduta o l’andamento in PDF in inglese, tedesco o italiano</translation>
    </message>
    <message>
        <source>wrist and finger angles while the patient moves</source>
        <translation>gli angoli di polso e dita durante il movimento</translation>
    </message>
    <message>
        <source>{count} pairs, {kind}</source>
        <translation>{count} coppie, {kind}</translation>
    </message>
    <message>
        <source>AMA Guides; AAOS 1965 (goniometer)</source>
        <translation>AMA Guides; AAOS 1965 (goniometro)</translation>
    </message>
    <message>
        <source>ASSH, sum of active flexion in a fist</source>
        <translation>ASSH, somma della flessione attiva nel pugno</translation>
    </message>
    <message>
        <source>The packaged program does not include {packages}. Carpus installed from source can use it.</source>
        <translation>Il pacchetto del programma non include {packages}. Carpus installato dai sorgenti può usarlo.</translation>
    </message>
    <message>
        <source>not readable as a table: {why}</source>
        <translation>non leggibile come tabella: {why}</translation>
    </message>
    <message>
        <source>not chosen yet</source>
        <translation>non ancora scelta</translation>
    </message>
    <message>
        <source>not available now</source>
        <translation>al momento non disponibile</translation>
    </message>
    <message>
        <source>not connected</source>
        <translation>non collegata</translation>
    </message>
    <message>
        <source>{free} GB free</source>
        <translation>{free} GB liberi</translation>
    </message>
    <message>
        <source>on the same disk as the data</source>
        <translation>sullo stesso disco dei dati</translation>
    </message>
    <message>
        <source>There is no backup yet.</source>
        <translation>Non c’è ancora nessuna copia di sicurezza.</translation>
    </message>
    <message>
        <source>The last backup is {days} days old.</source>
        <translation>L’ultima copia di sicurezza è di {days} giorni fa.</translation>
    </message>
    <message>
        <source>{when} · {n} session files, {size} GB · verified</source>
        <translation>{when} · {n} file di sedute, {size} GB · verificati</translation>
    </message>
    <message>
        <source>{when} · 1 session file, {size} GB · verified</source>
        <translation>{when} · 1 file di seduta, {size} GB · verificato</translation>
    </message>
    <message>
        <source>Reminder after {days} days.</source>
        <translation>Promemoria dopo {days} giorni.</translation>
    </message>
    <message>
        <source>only {time} s of overlap: the time shift is uncertain</source>
        <translation>solo {time} s di sovrapposizione: lo sfasamento è incerto</translation>
    </message>
    <message>
        <source>the curves and camera images, and correct single repetitions</source>
        <translation>curve e fotogrammi, con correzione delle singole ripetizioni</translation>
    </message>
    <message>
        <source>the best time shift is at the limit of the search range: it may be larger</source>
        <translation>lo sfasamento migliore è al limite della ricerca: può essere maggiore</translation>
    </message>
    <message>
        <source>the clocks drift: the reference by {percent} % relative to Carpus, {seconds} s over {length} s. The values contain this error (lag {lag} s with drift {drift} %)</source>
        <translation>gli orologi divergono: scarto del riferimento rispetto a Carpus {percent} %, {seconds} s in {length} s. I valori contengono questo errore (sfasamento {lag} s con deriva {drift} %)</translation>
    </message>
    <message>
        <source>the time shift is uncertain: {taken} s is used ({match}). Equally or nearly as good: {others}</source>
        <translation>lo sfasamento è incerto: si usa {taken} s ({match}). Altrettanto o quasi validi: {others}</translation>
    </message>
    <message>
        <source>women and men together</source>
        <translation>donne e uomini insieme</translation>
    </message>
    <message>
        <source>{angle}: opposite to Carpus (r = {r}). One of the two has the opposite sign or shows another movement</source>
        <translation>{angle}: opposto a Carpus (r = {r}). Uno dei due ha il segno opposto o mostra un altro movimento</translation>
    </message>
    <message>
        <source>{people} people are too few for group values: three are needed</source>
        <translation>{people} persone sono troppo poche per valori di gruppo: ne servono tre</translation>
    </message>
    <message>
        <source>{people} people, {sessions} sessions, {kinds}</source>
        <translation>{people} persone, {sessions} sedute, {kinds}</translation>
    </message>
    <message>
        <source>more than {count} characters</source>
        <translation>più di {count} caratteri</translation>
    </message>
    <message>
        <source>not in the session folder</source>
        <translation>non è nella cartella delle sedute</translation>
    </message>
    <message>
        <source>No change beyond measurement error since {day}.</source>
        <translation>Nessun cambiamento oltre l’errore di misura rispetto al giorno {day}.</translation>
    </message>
    <message>
        <source>{name}: no change beyond measurement error.</source>
        <translation>{name}: nessun cambiamento oltre l’errore di misura.</translation>
    </message>
    <message>
        <source>No change beyond measurement error since {when}.</source>
        <translation>Nessun cambiamento oltre l’errore di misura rispetto al giorno {when}.</translation>
    </message>
    <message>
        <source>no change beyond MDC</source>
        <translation>nessun cambiamento oltre l’MDC</translation>
    </message>
    <message>
        <source>{sign} = minimum: the end of this movement was occluded.</source>
        <translation>{sign} = minimo: la fine di questo movimento era nascosta.</translation>
    </message>
    <message>
        <source>Active</source>
        <translation>Attivo</translation>
    </message>
    <message>
        <source>Passive</source>
        <translation>Passivo</translation>
    </message>
    <message>
        <source>Passive minus active</source>
        <translation>Passivo meno attivo</translation>
    </message>
    <message>
        <source>Finger</source>
        <translation>Dito</translation>
    </message>
    <message>
        <source>within MDC</source>
        <translation>entro l’MDC</translation>
    </message>
    <message>
        <source>{gap} (MDC {limit})</source>
        <translation>{gap} (MDC {limit})</translation>
    </message>
    <message>
        <source>{name}: active {active}, passive {passive}. The difference of {gap} is beyond the measurement error.</source>
        <translation>{name}: attivo {active}, passivo {passive}. La differenza di {gap} supera l’errore di misura.</translation>
    </message>
    <message>
        <source>Active and passive range are shown without an assessment: {why}.</source>
        <translation>Escursione attiva e passiva senza valutazione: {why}.</translation>
    </message>
    <message>
        <source>You have kept the progress you made.</source>
        <translation>Ha mantenuto i progressi fatti.</translation>
    </message>
    <message>
        <source>You have reached our goal.</source>
        <translation>Ha raggiunto il nostro obiettivo.</translation>
    </message>
    <message>
        <source>You are more than halfway to our goal.</source>
        <translation>È oltre la metà del percorso verso il nostro obiettivo.</translation>
    </message>
    <message>
        <source>You can move further than when you started.</source>
        <translation>Riesce a muovere la mano più di quando ha iniziato.</translation>
    </message>
    <message>
        <source>once</source>
        <translation>una volta</translation>
    </message>
    <message>
        <source>{count} times</source>
        <translation>{count} volte</translation>
    </message>
    <message>
        <source>once a day</source>
        <translation>una volta al giorno</translation>
    </message>
    <message>
        <source>{count} times a day</source>
        <translation>{count} volte al giorno</translation>
    </message>
    <message>
        <source>dashed: at the start; solid: today</source>
        <translation>tratteggiata: all’inizio; continua: oggi</translation>
    </message>
    <message>
        <source>dashed: at the start; solid: today; green: our goal</source>
        <translation>tratteggiata: all’inizio; continua: oggi; verde: il nostro obiettivo</translation>
    </message>
    <message>
        <source>our goal</source>
        <translation>obiettivo</translation>
    </message>
    <message>
        <source>Next appointment</source>
        <translation>Prossimo appuntamento</translation>
    </message>
    <message>
        <source>The computer is too busy</source>
        <translation>Il computer è sovraccarico</translation>
    </message>
    <message>
        <source>{count} frames are missing: close other programs</source>
        <translation>Mancano {count} fotogrammi: chiudere altri programmi</translation>
    </message>
    <message>
        <source>The computer is busy; every frame is saved</source>
        <translation>Il computer è occupato; non si perde nulla</translation>
    </message>
    <message>
        <source>Values are {seconds} s behind</source>
        <translation>Valori in ritardo di {seconds} s</translation>
    </message>
    <message>
        <source>The computer is busy</source>
        <translation>Il computer è occupato</translation>
    </message>
    <message>
        <source>{time} of {whole}</source>
        <translation>{time} di {whole}</translation>
    </message>
    <message>
        <source>{angle}, passive</source>
        <translation>{angle}, passiva</translation>
    </message>
    <message>
        <source>Simulated hand</source>
        <translation>Mano simulata</translation>
    </message>
    <message>
        <source>1 marker occluded</source>
        <translation>1 marcatore nascosto</translation>
    </message>
    <message>
        <source>report</source>
        <translation>relazione</translation>
    </message>
    <message>
        <source>letter</source>
        <translation>lettera</translation>
    </message>
    <message>
        <source>home</source>
        <translation>a-casa</translation>
    </message>
    <message>
        <source>progress</source>
        <translation>andamento</translation>
    </message>
    <message>
        <source>Repetitions</source>
        <translation>Ripetizioni</translation>
    </message>
    <message>
        <source>Range of motion, fingers</source>
        <translation>Escursione articolare, dita</translation>
    </message>
    <message>
        <source>Speed and smoothness</source>
        <translation>Velocità e fluidità</translation>
    </message>
    <message>
        <source>Quality of the recording</source>
        <translation>Qualità della registrazione</translation>
    </message>
    <message>
        <source>Reaching movements</source>
        <translation>Movimenti di raggiungimento</translation>
    </message>
    <message>
        <source>not available: fewer than {count} frames a second</source>
        <translation>non disponibile: meno di {count} fotogrammi al secondo</translation>
    </message>
    <message>
        <source>not available: the calculation failed</source>
        <translation>non disponibile: calcolo non riuscito</translation>
    </message>
    <message>
        <source>{verdict} Checked {day}.</source>
        <translation>{verdict} Controllata in data {day}.</translation>
    </message>
    <message>
        <source>never calibrated</source>
        <translation>mai calibrata</translation>
    </message>
    <message>
        <source>calibrated {ago}</source>
        <translation>calibrata {ago}</translation>
    </message>
    <message>
        <source>Camera {serial}: {calibrated}. {words}</source>
        <translation>Telecamera {serial}: {calibrated}. {words}</translation>
    </message>
    <message>
        <source>the reference contains both hands: {names} are used</source>
        <translation>Il riferimento contiene entrambe le mani; si usano {names}</translation>
    </message>
    <message>
        <source>no marker {wanted}, only {names}</source>
        <translation>nessun marcatore {wanted}, solo {names}</translation>
    </message>
    <message>
        <source>{several} found for {wanted}: state which one applies</source>
        <translation>per {wanted} ci sono {several}: indicare quale vale</translation>
    </message>
    <message>
        <source>line {line}: “{cell}” is not a reading</source>
        <translation>riga {line}: “{cell}” non è una misura</translation>
    </message>
    <message>
        <source>nothing</source>
        <translation>nulla</translation>
    </message>
    <message>
        <source>rows with the time of the previous row were excluded ({count})</source>
        <translation>righe con il tempo della riga precedente escluse ({count})</translation>
    </message>
    <message>
        <source>the cells of {name} are not times</source>
        <translation>le celle di {name} non sono tempi</translation>
    </message>
    <message>
        <source>{names}: their names belong to the other hand</source>
        <translation>{names}: secondo il nome appartengono all’altra mano</translation>
    </message>
    <message>
        <source>{name}: cells that are not numbers were excluded ({count}), the first is “{cell}” in line {line}</source>
        <translation>{name}: celle che non sono numeri escluse ({count}), la prima è “{cell}” alla riga {line}</translation>
    </message>
    <message>
        <source>{name}: read as {unit}, because there is a row every {step}</source>
        <translation>{name}: letto in {unit}, poiché c’è una riga ogni {step}</translation>
    </message>
    <message>
        <source>no time column: state which of {names} it is</source>
        <translation>nessuna colonna dei tempi; indicare quale è tra {names}</translation>
    </message>
    <message>
        <source>no column reading_deg, only {names}</source>
        <translation>nessuna colonna reading_deg, solo {names}</translation>
    </message>
    <message>
        <source>no column {wanted}, only {names}</source>
        <translation>nessuna colonna {wanted}, solo {names}</translation>
    </message>
    <message>
        <source>no angle of the session, only {there}</source>
        <translation>nessun angolo della seduta, solo {there}</translation>
    </message>
    <message>
        <source>no palm marker and no angle of the wrist or fingers, only {there}</source>
        <translation>nessun marcatore del palmo e nessun angolo di polso o dita, solo {there}</translation>
    </message>
    <message>
        <source>three palm markers are needed: state which of {there} they are</source>
        <translation>servono tre marcatori del palmo: indicare quali sono tra {there}</translation>
    </message>
    <message>
        <source>depth in millimetres, not 5000 per metre</source>
        <translation>profondità in millimetri, non 5000 per metro</translation>
    </message>
    <message>
        <source>depth_unit_m is not metres per count, as 0.001 or 0.0002</source>
        <translation>depth_unit_m non indica metri per unità, come 0.001 o 0.0002</translation>
    </message>
    <message>
        <source>times in {unit}, not in seconds</source>
        <translation>tempi in {unit}, non in secondi</translation>
    </message>
    <message>
        <source>Rotation from the start</source>
        <translation>Rotazione dall’inizio</translation>
    </message>
    <message>
        <source>0° = thumb up</source>
        <translation>0° = pollice in alto</translation>
    </message>
    <message>
        <source>Forearm supination</source>
        <translation>Supinazione dell’avambraccio</translation>
    </message>
    <message>
        <source>Forearm pronation</source>
        <translation>Pronazione dell’avambraccio</translation>
    </message>
    <message>
        <source>Rotation +</source>
        <translation>Rotazione +</translation>
    </message>
    <message>
        <source>Rotation −</source>
        <translation>Rotazione −</translation>
    </message>
    <message>
        <source>Thumb up</source>
        <translation>Pollice in alto</translation>
    </message>
    <message>
        <source>As at the start</source>
        <translation>Come all’inizio</translation>
    </message>
    <message>
        <source>Forearm rotation</source>
        <translation>Rotazione dell’avambraccio</translation>
    </message>
    <message>
        <source>Calibrate the camera again, or correct the file.</source>
        <translation>Calibrare di nuovo la telecamera, o correggere il file.</translation>
    </message>
    <message>
        <source>People: {people}, sessions: {sessions}.</source>
        <translation>Persone: {people}, sedute: {sessions}.</translation>
    </message>
    <message>
        <source>measured once</source>
        <translation>misurata una volta</translation>
    </message>
    <message>
        <source>Distance: near and far missing</source>
        <translation>Distanza: mancano vicino e lontano</translation>
    </message>
    <message>
        <source>Tilts: {side} missing</source>
        <translation>Inclinazioni: manca {side}</translation>
    </message>
    <message>
        <source>Tilts: all sides</source>
        <translation>Inclinazioni: tutti i lati</translation>
    </message>
    <message>
        <source>Distance: {near}–{far} cm</source>
        <translation>Distanza: {near}–{far} cm</translation>
    </message>
    <message>
        <source>{px} px before</source>
        <translation>prima {px} px</translation>
    </message>
    <message>
        <source>Hand not visible</source>
        <translation>Mano non visibile</translation>
    </message>
    <message>
        <source>Hold still</source>
        <translation>Tieni ferma la mano</translation>
    </message>
    <message>
        <source>Bend the wrist up, then down, as far as is comfortable. Keep the forearm still.</source>
        <translation>Piegare il polso in su, poi in giù, fin dove non dà fastidio. L’avambraccio resta fermo.</translation>
    </message>
    <message>
        <source>File not found: {subject}.</source>
        <translation>File non trovato: {subject}.</translation>
    </message>
    <message>
        <source>Keep the MCP joints straight. Bend the PIP and DIP joints into a hook, then straighten.</source>
        <translation>Tenere distese le articolazioni MCF. Piegare le IFP e le IFD a uncino, poi distenderle.</translation>
    </message>
    <message>
        <source>Tilt the hand towards the thumb, then towards the little finger. Keep the forearm still.</source>
        <translation>Inclinare la mano verso il pollice, poi verso il mignolo. L’avambraccio resta fermo.</translation>
    </message>
    <message>
        <source>Tilt your hand towards your little finger</source>
        <translation>Inclini la mano verso il mignolo</translation>
    </message>
    <message>
        <source>Tilt your hand towards your thumb</source>
        <translation>Inclini la mano verso il pollice</translation>
    </message>
    <message>
        <source>not a file</source>
        <translation>non è un file</translation>
    </message>
    <message>
        <source>Passive range does not exceed active range by more than the measurement error.</source>
        <translation>L’escursione passiva non supera quella attiva oltre l’errore di misura.</translation>
    </message>
    <message>
        <source>Record this exercise again.</source>
        <translation>Registrare di nuovo questo esercizio.</translation>
    </message>
    <message>
        <source>no answer for {seconds} s</source>
        <translation>nessuna risposta da {seconds} s</translation>
    </message>
    <message>
        <source>not a recording journal</source>
        <translation>non è un giornale di registrazione</translation>
    </message>
    <message>
        <source>no answer</source>
        <translation>nessuna risposta</translation>
    </message>
    <message>
        <source>the hand left the camera’s view during the movement</source>
        <translation>la mano è uscita dall’inquadratura durante il movimento</translation>
    </message>
    <message>
        <source>Compiled parts</source>
        <translation>Parti compilate</translation>
    </message>
    <message>
        <source>complete</source>
        <translation>complete</translation>
    </message>
    <message>
        <source>A click lies outside the image: {subject} ({detail}).</source>
        <translation>Un clic è fuori dall’immagine: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>A different camera is connected ({detail}). Carpus expects {subject}.</source>
        <translation>È collegata un’altra telecamera ({detail}). Carpus aspetta {subject}.</translation>
    </message>
    <message>
        <source>A file with this name already exists: {subject}.</source>
        <translation>Esiste già un file con questo nome: {subject}.</translation>
    </message>
    <message>
        <source>A frame of the recording is damaged: {subject} ({detail}).</source>
        <translation>Un fotogramma della registrazione è danneggiato: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>A setting is invalid: {subject} ({detail}).</source>
        <translation>Un’impostazione non è valida: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>All other files are in the backup.</source>
        <translation>Tutti gli altri file sono nella copia di sicurezza.</translation>
    </message>
    <message>
        <source>All other frames are used. The gaps are marked.</source>
        <translation>Tutti gli altri fotogrammi vengono usati. Le lacune sono indicate.</translation>
    </message>
    <message>
        <source>All sessions are safe. If there was a list before, its names, notes and comments are missing.</source>
        <translation>Tutte le sedute sono al sicuro. Se prima esisteva un elenco, mancano i suoi nomi, note e commenti.</translation>
    </message>
    <message>
        <source>All sessions are safe. Names, notes and comments may be missing. The damaged list is kept as {subject}.</source>
        <translation>Tutte le sedute sono al sicuro. Nomi, note e commenti possono mancare. L’elenco danneggiato è conservato come {subject}.</translation>
    </message>
    <message>
        <source>Another program is using the camera ({detail}).</source>
        <translation>Un altro programma sta usando la telecamera ({detail}).</translation>
    </message>
    <message>
        <source>Another program is writing {subject}.</source>
        <translation>Un altro programma sta scrivendo {subject}.</translation>
    </message>
    <message>
        <source>Ask your IT support for access to the camera.</source>
        <translation>Chiedere al supporto informatico l’accesso alla telecamera.</translation>
    </message>
    <message>
        <source>Ask your IT support to install it.</source>
        <translation>Chiedere al supporto informatico di installarlo.</translation>
    </message>
    <message>
        <source>Ask your IT support to install the driver.</source>
        <translation>Chiedere al supporto informatico di installare il driver.</translation>
    </message>
    <message>
        <source>Ask your IT support to reinstall Carpus.</source>
        <translation>Chiedere al supporto informatico di reinstallare Carpus.</translation>
    </message>
    <message>
        <source>Backup</source>
        <translation>Copia di sicurezza</translation>
    </message>
    <message>
        <source>Calibrate the camera in the settings.</source>
        <translation>Calibrare la telecamera nelle impostazioni.</translation>
    </message>
    <message>
        <source>Carpus was not installed completely: a compiled part is missing ({subject}).</source>
        <translation>Carpus non è stato installato completamente: manca una parte compilata ({subject}).</translation>
    </message>
    <message>
        <source>Check that the network share is connected.</source>
        <translation>Controllare che la condivisione di rete sia collegata.</translation>
    </message>
    <message>
        <source>Check the list, or restore a backup.</source>
        <translation>Controllare l’elenco, o ripristinare una copia di sicurezza.</translation>
    </message>
    <message>
        <source>Choose an existing patient.</source>
        <translation>Scegliere un paziente esistente.</translation>
    </message>
    <message>
        <source>Choose another backup, or update Carpus.</source>
        <translation>Scegliere un’altra copia di sicurezza, o aggiornare Carpus.</translation>
    </message>
    <message>
        <source>Choose the camera in the settings.</source>
        <translation>Scegliere la telecamera nelle impostazioni.</translation>
    </message>
    <message>
        <source>Choose the folder that contains the backups.</source>
        <translation>Scegliere la cartella che contiene le copie di sicurezza.</translation>
    </message>
    <message>
        <source>Choose the folder that contains the patients.</source>
        <translation>Scegliere la cartella che contiene i pazienti.</translation>
    </message>
    <message>
        <source>Choose the folder that contains the sessions.</source>
        <translation>Scegliere la cartella che contiene le sedute.</translation>
    </message>
    <message>
        <source>Click every marker again, in the order shown.</source>
        <translation>Fare di nuovo clic su tutti i marcatori, nell’ordine indicato.</translation>
    </message>
    <message>
        <source>Click the marker in the first frame of this recording.</source>
        <translation>Fare clic sul marcatore nel primo fotogramma di questa registrazione.</translation>
    </message>
    <message>
        <source>Click the markers again, or correct the file.</source>
        <translation>Fare di nuovo clic sui marcatori, o correggere il file.</translation>
    </message>
    <message>
        <source>Close Carpus on other computers. If that does not help, ask your IT support for write access.</source>
        <translation>Chiudere Carpus sugli altri computer. Se non basta, chiedere al supporto informatico l’accesso in scrittura.</translation>
    </message>
    <message>
        <source>Comparison</source>
        <translation>Confronto</translation>
    </message>
    <message>
        <source>Copy the recording again from its source.</source>
        <translation>Copiare di nuovo la registrazione dall’origine.</translation>
    </message>
    <message>
        <source>Correct the setting, or remove it to use the default.</source>
        <translation>Correggere l’impostazione, o toglierla per usare quella predefinita.</translation>
    </message>
    <message>
        <source>Damaged frames were excluded: {subject} ({detail}).</source>
        <translation>I fotogrammi danneggiati sono stati esclusi: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>Depth and colour are not aligned in {subject}, so depths are less accurate.</source>
        <translation>Profondità e colore non sono allineati in {subject}, quindi le profondità sono meno precise.</translation>
    </message>
    <message>
        <source>Everything recorded before is safe.</source>
        <translation>Tutto ciò che è stato registrato prima è al sicuro.</translation>
    </message>
    <message>
        <source>Everything recorded so far is saved on this computer.</source>
        <translation>Tutto ciò che è stato registrato finora è salvato su questo computer.</translation>
    </message>
    <message>
        <source>Everything saved until then is safe.</source>
        <translation>Tutto ciò che era stato salvato fino ad allora è al sicuro.</translation>
    </message>
    <message>
        <source>Exclude the repetitions that are wrong, or record again.</source>
        <translation>Escludere le ripetizioni sbagliate, o registrare di nuovo.</translation>
    </message>
    <message>
        <source>Files</source>
        <translation>File</translation>
    </message>
    <message>
        <source>Frames with a repeated time were excluded: {subject} ({detail}).</source>
        <translation>I fotogrammi con un tempo ripetuto sono stati esclusi: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>Hold the whole printed board in the camera image, in good light.</source>
        <translation>Tenere l’intera tavola stampata nell’immagine della telecamera, con buona luce.</translation>
    </message>
    <message>
        <source>If there are many, copy the recording again.</source>
        <translation>Se sono molti, copiare di nuovo la registrazione.</translation>
    </message>
    <message>
        <source>If there are many, record again.</source>
        <translation>Se sono molti, registrare di nuovo.</translation>
    </message>
    <message>
        <source>Installation</source>
        <translation>Installazione</translation>
    </message>
    <message>
        <source>Keep the light constant while you measure.</source>
        <translation>Mantenere costante la luce durante la misurazione.</translation>
    </message>
    <message>
        <source>Measure at least 10 people twice within 14 days, and replace the markers each time.</source>
        <translation>Misurare almeno 10 persone due volte entro 14 giorni, riposizionando ogni volta i marcatori.</translation>
    </message>
    <message>
        <source>Move the board further away</source>
        <translation>Allontanare la tavola</translation>
    </message>
    <message>
        <source>Move the camera further from the hand.</source>
        <translation>Allontanare la telecamera dalla mano.</translation>
    </message>
    <message>
        <source>Move the hand a little. Keep sunlight and reflections off the markers.</source>
        <translation>Spostare un poco la mano. Evitare sole e riflessi sui marcatori.</translation>
    </message>
    <message>
        <source>No camera was found ({detail}).</source>
        <translation>Non è stata trovata nessuna telecamera ({detail}).</translation>
    </message>
    <message>
        <source>No separate blue marker was found at a click: {subject}.</source>
        <translation>Nel punto del clic non è stato trovato un marcatore blu distinto: {subject}.</translation>
    </message>
    <message>
        <source>Nothing else was changed.</source>
        <translation>Nient’altro è stato modificato.</translation>
    </message>
    <message>
        <source>Nothing has been recorded yet.</source>
        <translation>Non è stato ancora registrato nulla.</translation>
    </message>
    <message>
        <source>Nothing was changed.</source>
        <translation>Non è stato modificato nulla.</translation>
    </message>
    <message>
        <source>Nothing was changed. New recordings are kept on this computer.</source>
        <translation>Non è stato modificato nulla. Le nuove registrazioni restano su questo computer.</translation>
    </message>
    <message>
        <source>Nothing was deleted: {subject} is a link to another place.</source>
        <translation>Non è stato eliminato nulla: {subject} è un collegamento a un’altra posizione.</translation>
    </message>
    <message>
        <source>Patients</source>
        <translation>Pazienti</translation>
    </message>
    <message>
        <source>Plug the camera directly into the computer.</source>
        <translation>Collegare la telecamera direttamente al computer.</translation>
    </message>
    <message>
        <source>Recent changes to the patient list cannot be read, because the folder is read-only: {subject}.</source>
        <translation>Le ultime modifiche all’elenco dei pazienti non si possono leggere, perché la cartella è di sola lettura: {subject}.</translation>
    </message>
    <message>
        <source>Reconnect the session folder or its disk, then back up again.</source>
        <translation>Ricollegare la cartella delle sedute o il suo disco, poi ripetere la copia di sicurezza.</translation>
    </message>
    <message>
        <source>Record again with colour and depth of the same size.</source>
        <translation>Registrare di nuovo con colore e profondità della stessa dimensione.</translation>
    </message>
    <message>
        <source>Record again, or correct the list of frames.</source>
        <translation>Registrare di nuovo, o correggere l’elenco dei fotogrammi.</translation>
    </message>
    <message>
        <source>Record to a disk in this computer, and close other programs.</source>
        <translation>Registrare su un disco di questo computer, e chiudere gli altri programmi.</translation>
    </message>
    <message>
        <source>Recording</source>
        <translation>Registrazione</translation>
    </message>
    <message>
        <source>Recording not found: {subject} ({detail}).</source>
        <translation>Registrazione non trovata: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>Restart Carpus. If that does not help, ask your IT support.</source>
        <translation>Riavviare Carpus. Se non basta, chiedere al supporto informatico.</translation>
    </message>
    <message>
        <source>Restore a backup, or enter the names again.</source>
        <translation>Ripristinare una copia di sicurezza, o inserire di nuovo i nomi.</translation>
    </message>
    <message>
        <source>Review it like any other session.</source>
        <translation>Rivederla come ogni altra seduta.</translation>
    </message>
    <message>
        <source>Smoothing of this session failed: {subject} ({detail}).</source>
        <translation>Lo smoothing di questa seduta non è riuscito: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>Someone else changed this record, so your change was not saved.</source>
        <translation>Qualcun altro ha modificato questa scheda, quindi la modifica non è stata salvata.</translation>
    </message>
    <message>
        <source>The backup cannot be read: {subject} ({detail}).</source>
        <translation>La copia di sicurezza non può essere letta: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The calibration board is not visible: {subject} ({detail}).</source>
        <translation>La tavola di calibrazione non è visibile: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The camera cannot keep its exposure constant: {subject}.</source>
        <translation>La telecamera non riesce a mantenere costante l’esposizione: {subject}.</translation>
    </message>
    <message>
        <source>The camera driver has stopped: {subject} ({detail}).</source>
        <translation>Il driver della telecamera si è arrestato: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The camera driver is not installed or cannot be loaded ({detail}).</source>
        <translation>Il driver della telecamera non è installato o non può essere caricato ({detail}).</translation>
    </message>
    <message>
        <source>The camera file cannot be used: {subject} ({detail}).</source>
        <translation>Il file della telecamera non può essere usato: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The camera has stopped sending images: {subject} ({detail}).</source>
        <translation>La telecamera non invia più immagini: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The camera’s calibration was not changed.</source>
        <translation>La calibrazione della telecamera non è stata modificata.</translation>
    </message>
    <message>
        <source>The check card is not visible: {subject} ({detail}).</source>
        <translation>Il cartoncino di controllo non è visibile: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The clicked markers cannot be read: {subject} ({detail}).</source>
        <translation>I clic sui marcatori non si possono leggere: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The clicked points do not form a hand ({subject}).</source>
        <translation>I punti indicati non formano una mano ({subject}).</translation>
    </message>
    <message>
        <source>The data on this computer are intact.</source>
        <translation>I dati su questo computer sono integri.</translation>
    </message>
    <message>
        <source>The disk has no space left for {subject} ({detail}).</source>
        <translation>Il disco non ha più spazio per {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The disk is too slow, so the recording has ended: {subject} ({detail}).</source>
        <translation>Il disco è troppo lento, quindi la registrazione è terminata: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The file was not changed. All other sessions are safe.</source>
        <translation>Il file non è stato modificato. Tutte le altre sedute sono al sicuro.</translation>
    </message>
    <message>
        <source>The first frame of the recording is damaged: {subject} ({detail}).</source>
        <translation>Il primo fotogramma della registrazione è danneggiato: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The folder contains no Carpus data: {subject}.</source>
        <translation>La cartella non contiene dati di Carpus: {subject}.</translation>
    </message>
    <message>
        <source>The frame times are out of order: {subject} ({detail}).</source>
        <translation>I tempi dei fotogrammi non sono in ordine: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The frames of the recording differ in size: {subject} ({detail}).</source>
        <translation>I fotogrammi della registrazione hanno dimensioni diverse: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The image format of this recording is not supported: {subject} ({detail}).</source>
        <translation>Il formato delle immagini di questa registrazione non è supportato: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The images of the board are too few or too similar: {subject} ({detail}).</source>
        <translation>Le immagini della tavola sono troppo poche o troppo simili: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The live measurement is saved.</source>
        <translation>La misurazione dal vivo è salvata.</translation>
    </message>
    <message>
        <source>The measurement continues.</source>
        <translation>La misurazione continua.</translation>
    </message>
    <message>
        <source>The other change is saved.</source>
        <translation>L’altra modifica è salvata.</translation>
    </message>
    <message>
        <source>The patient list cannot be opened: {subject} ({detail}).</source>
        <translation>L’elenco dei pazienti non può essere aperto: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The patient list is damaged: {subject} ({detail}).</source>
        <translation>L’elenco dei pazienti è danneggiato: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The patient list is open in another window of Carpus or another program: {subject} ({detail}).</source>
        <translation>L’elenco dei pazienti è aperto in un’altra finestra di Carpus o in un altro programma: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The patient list was damaged. It was rebuilt from the sessions and what could be read ({detail}).</source>
        <translation>L’elenco dei pazienti era danneggiato. È stato ricostruito dalle sedute e da ciò che era leggibile ({detail}).</translation>
    </message>
    <message>
        <source>The patient list was missing and was rebuilt from the sessions: {subject}.</source>
        <translation>L’elenco dei pazienti mancava ed è stato ricostruito dalle sedute: {subject}.</translation>
    </message>
    <message>
        <source>The previous result was not changed.</source>
        <translation>Il risultato precedente non è stato modificato.</translation>
    </message>
    <message>
        <source>The re-analysis failed: {subject} ({detail}).</source>
        <translation>La nuova analisi non è riuscita: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The recording contains no frames: {subject} ({detail}).</source>
        <translation>La registrazione non contiene fotogrammi: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The session folder is not available ({detail}). The session is saved in {subject}.</source>
        <translation>La cartella delle sedute non è disponibile ({detail}). La seduta è salvata in {subject}.</translation>
    </message>
    <message>
        <source>The session was not changed.</source>
        <translation>La seduta non è stata modificata.</translation>
    </message>
    <message>
        <source>There is no backup in {subject}.</source>
        <translation>In {subject} non ci sono copie di sicurezza.</translation>
    </message>
    <message>
        <source>There is no patient called {subject} ({detail}).</source>
        <translation>Non esiste un paziente chiamato {subject} ({detail}).</translation>
    </message>
    <message>
        <source>This camera does not deliver the images that Carpus needs: {subject} ({detail}).</source>
        <translation>Questa telecamera non fornisce le immagini di cui Carpus ha bisogno: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>This session cannot be opened: {subject} ({detail}).</source>
        <translation>Questa seduta non può essere aperta: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>This session was modified after it was completed: {subject}.</source>
        <translation>Questa seduta è stata modificata dopo la sua conclusione: {subject}.</translation>
    </message>
    <message>
        <source>Try again, or correct another frame first.</source>
        <translation>Riprovare, o correggere prima un altro fotogramma.</translation>
    </message>
    <message>
        <source>Turn on depth registration in the camera settings next time.</source>
        <translation>La prossima volta attivare l’allineamento profondità-colore nelle impostazioni della telecamera.</translation>
    </message>
    <message>
        <source>Type the name instead of pasting it.</source>
        <translation>Digitare il nome invece di incollarlo.</translation>
    </message>
    <message>
        <source>Update Carpus on this computer.</source>
        <translation>Aggiornare Carpus su questo computer.</translation>
    </message>
    <message>
        <source>Use a recording whose frames all have the same size.</source>
        <translation>Usare una registrazione i cui fotogrammi abbiano tutti la stessa dimensione.</translation>
    </message>
    <message>
        <source>Use a recording with colour and depth.</source>
        <translation>Usare una registrazione con colore e profondità.</translation>
    </message>
    <message>
        <source>Use the same size for colour and depth next time.</source>
        <translation>La prossima volta usare la stessa dimensione per colore e profondità.</translation>
    </message>
    <message>
        <source>Use the window that is already open, or choose another folder.</source>
        <translation>Usare la finestra già aperta, o scegliere un’altra cartella.</translation>
    </message>
    <message>
        <source>Write “registered: true” or “registered: false” into camera_info.yaml.</source>
        <translation>Scrivere “registered: true” o “registered: false” in camera_info.yaml.</translation>
    </message>
    <message>
        <source>You do not have permission to open the camera ({detail}).</source>
        <translation>Mancano i permessi per aprire la telecamera ({detail}).</translation>
    </message>
    <message>
        <source>a study&apos;s table needs the columns person, session and reference</source>
        <translation>la tabella di uno studio richiede le colonne person, session e reference</translation>
    </message>
    <message>
        <source>adults (ages not stated, not for children or older people)</source>
        <translation>adulti (età non indicata, non per bambini e anziani)</translation>
    </message>
    <message>
        <source>it contains more than one record</source>
        <translation>contiene più di un record</translation>
    </message>
    <message>
        <source>{value} is none of {choices}, in {file}</source>
        <translation>{value} non è tra i valori ammessi: {choices} (in {file})</translation>
    </message>
    <message>
        <source>{value} is not a number, in {file}</source>
        <translation>{value} non è un numero (in {file})</translation>
    </message>
    <message>
        <source>{value} is not a text, in {file}</source>
        <translation>{value} non è un testo (in {file})</translation>
    </message>
    <message>
        <source>{value} is not a whole number, in {file}</source>
        <translation>{value} non è un numero intero (in {file})</translation>
    </message>
    <message>
        <source>{value} is not true or false, in {file}</source>
        <translation>{value} non è né true né false (in {file})</translation>
    </message>
    <message>
        <source>{value} is not valid, in {file}</source>
        <translation>{value} non è valido (in {file})</translation>
    </message>
    <message>
        <source>“carpus track SESSION.h5 --output NEW.h5” repeats the smoothing.</source>
        <translation>“carpus track SEDUTA.h5 --output NUOVA.h5” ripete lo smoothing.</translation>
    </message>
    <message>
        <source>Last backup: {day}.</source>
        <translation>Ultima copia di sicurezza: {day}.</translation>
    </message>
    <message>
        <source>An unexpected error occurred.</source>
        <translation>Si è verificato un errore imprevisto.</translation>
    </message>
    <message>
        <source>Everything saved before is safe.</source>
        <translation>Tutto ciò che era già salvato è al sicuro.</translation>
    </message>
    <message>
        <source>Try again. If it happens again, restart Carpus and show the details to your IT support.</source>
        <translation>Riprovare. Se succede ancora, riavviare Carpus e mostrare i dettagli al supporto informatico.</translation>
    </message>
    <message>
        <source>Program</source>
        <translation>Programma</translation>
    </message>
    <message>
        <source>Labels given while measuring ({count}) are not part of the new result. Check the markers.</source>
        <translation>Le etichette assegnate durante la registrazione ({count}) non fanno parte del nuovo risultato. Controllare i marcatori.</translation>
    </message>
    <message>
        <source>Rarely visible in the new result: {names}. Their angles are missing there.</source>
        <translation>Quasi mai visibili nel nuovo risultato: {names}. Lì mancano i loro angoli.</translation>
    </message>
    <message>
        <source>{count} of {common} frames differ by more than 2°. Largest difference at {time}: {angle}, {size}.</source>
        <translation>{count} fotogrammi su {common} differiscono di più di 2°. Differenza massima a {time}: {angle}, {size}.</translation>
    </message>
    <message>
        <source>No frame differs by more than 2°.</source>
        <translation>Nessun fotogramma differisce di più di 2°.</translation>
    </message>
    <message>
        <source>{count} frames have an angle that was missing before.</source>
        <translation>{count} fotogrammi hanno un angolo che prima mancava.</translation>
    </message>
    <message>
        <source>Live values are compared, because one of the two results is not smoothed.</source>
        <translation>Si confrontano i valori dal vivo, perché uno dei due risultati è senza smoothing.</translation>
    </message>
    <message>
        <source>excluded: simulated</source>
        <translation>esclusa: simulata</translation>
    </message>
    <message>
        <source>excluded: {reason}</source>
        <translation>esclusa: {reason}</translation>
    </message>
    <message>
        <source>file missing</source>
        <translation>file mancante</translation>
    </message>
    <message>
        <source>This image cannot be read. Choose a PNG or JPEG file.</source>
        <translation>Questa immagine non si può leggere. Scegliere un file PNG o JPEG.</translation>
    </message>
    <message>
        <source>This image is larger than 8 MB. Choose a smaller one.</source>
        <translation>Questa immagine supera 8 MB. Sceglierne una più piccola.</translation>
    </message>
    <message>
        <source>Carpus cannot read this file as an image. Choose a PNG or JPEG file.</source>
        <translation>Carpus non può leggere questo file come immagine. Scegliere un file PNG o JPEG.</translation>
    </message>
    <message>
        <source>This image is too small to print. Choose one of at least 32 × 32 pixels.</source>
        <translation>Questa immagine è troppo piccola per la stampa. Sceglierne una di almeno 32 × 32 pixel.</translation>
    </message>
    <message>
        <source>Rotation</source>
        <translation>Rotazione</translation>
    </message>
    <message>
        <source>Frames with occluded joints are not analysed.</source>
        <translation>I fotogrammi con articolazioni nascoste non vengono analizzati.</translation>
    </message>
    <message>
        <source>Nothing was changed. Glue the board onto something flat and stiff. Take the images again in good light.</source>
        <translation>Non è stato modificato nulla. Incollare la tavola su qualcosa di piano e rigido, e rifare le immagini con buona luce.</translation>
    </message>
    <message>
        <source>Depth was not checked.</source>
        <translation>La profondità non è stata controllata.</translation>
    </message>
    <message>
        <source>Lay the card flat under the camera, fully in view, about 60 cm away.</source>
        <translation>Mettere il cartoncino piatto sotto la telecamera, tutto inquadrato, a circa 60 cm.</translation>
    </message>
    <message>
        <source>The card moved: the countdown starts again.</source>
        <translation>Il cartoncino si è mosso: il conto alla rovescia riparte.</translation>
    </message>
    <message>
        <source>Abduction</source>
        <translation>Abduzione</translation>
    </message>
    <message>
        <source>Extended</source>
        <translation>Esteso</translation>
    </message>
    <message>
        <source>Flexed {angle}</source>
        <translation>Flesso {angle}</translation>
    </message>
    <message>
        <source>add.</source>
        <translation>add.</translation>
    </message>
    <message>
        <source>abd.</source>
        <translation>abd.</translation>
    </message>
    <message>
        <source>Abd. {angle}</source>
        <translation>Abd. {angle}</translation>
    </message>
    <message>
        <source>Add. {angle}</source>
        <translation>Add. {angle}</translation>
    </message>
    <message>
        <source>Check the {marker}</source>
        <translation>Controllare: {marker}</translation>
    </message>
    <message>
        <source>Hand tracked well</source>
        <translation>Mano ben rilevata</translation>
    </message>
    <message>
        <source>manual, active</source>
        <translation>manuale, attivo</translation>
    </message>
    <message>
        <source>Position</source>
        <translation>Posizione</translation>
    </message>
    <message>
        <source>too slow to assess</source>
        <translation>troppo lento per valutare</translation>
    </message>
    <message>
        <source>abduction</source>
        <translation>abduzione</translation>
    </message>
    <message>
        <source>abduction of {fingers}</source>
        <translation>abduzione di: {fingers}</translation>
    </message>
    <message>
        <source>Partly occluded ({sign} = minimum): {parts}. Frames with occluded joints are not analysed.</source>
        <translation>In parte nascosti ({sign} = minimo): {parts}. I fotogrammi con articolazioni nascoste non vengono analizzati.</translation>
    </message>
    <message>
        <source>Abduction of all fingers</source>
        <translation>Abduzione di tutte le dita</translation>
    </message>
    <message>
        <source>Position, speed, rotation</source>
        <translation>Posizione, velocità, rotazione</translation>
    </message>
    <message>
        <source>Manual measurements</source>
        <translation>Misure manuali</translation>
    </message>
    <message>
        <source>Therapist’s comment</source>
        <translation>Commento del terapista</translation>
    </message>
    <message>
        <source>The comment is too long for this letter. It is in the report.</source>
        <translation>Il commento è troppo lungo per questa lettera. Si trova nella relazione.</translation>
    </message>
    <message>
        <source>{count} movement cycles; range over the whole recording</source>
        <translation>{count} cicli di movimento; escursione sull’intera registrazione</translation>
    </message>
    <message>
        <source>too short</source>
        <translation>troppo breve</translation>
    </message>
    <message>
        <source>± = SD between repetitions. The SD of a visible angle is about {sd}.</source>
        <translation>± = DS fra le ripetizioni. La DS di un angolo visibile è di circa {sd}.</translation>
    </message>
    <message>
        <source>± = SD between repetitions (with fewer than 3: SD of the estimate). The SD of a visible angle is about {sd}.</source>
        <translation>± = DS fra le ripetizioni (con meno di 3: DS della stima). La DS di un angolo visibile è di circa {sd}.</translation>
    </message>
    <message>
        <source>± = SD of the estimate, as there are too few repetitions. The SD of an angle is about {sd}.</source>
        <translation>± = DS della stima, perché le ripetizioni sono troppo poche. La DS di un angolo è di circa {sd}.</translation>
    </message>
    <message>
        <source>{share} of {frames}; {dropped} dropped</source>
        <translation>{share} di {frames}; {dropped} persi</translation>
    </message>
    <message>
        <source>Exercise set: {name}</source>
        <translation>Sequenza: {name}</translation>
    </message>
    <message>
        <source>Camera permissions, {title}</source>
        <translation>Permessi della telecamera, {title}</translation>
    </message>
    <message>
        <source>Reinstall it and the library it names.</source>
        <translation>Reinstallarlo, insieme alla libreria nominata.</translation>
    </message>
    <message>
        <source>Install the camera permissions named above and plug the camera in again.</source>
        <translation>Installare i permessi della telecamera nominati sopra e ricollegare la telecamera.</translation>
    </message>
    <message>
        <source>Depth registration</source>
        <translation>Allineamento profondità-colore</translation>
    </message>
    <message>
        <source>You have no permission to open {node}. Install the camera permissions named above, then plug the camera in again.</source>
        <translation>Manca il permesso di aprire {node}. Installare i permessi della telecamera nominati sopra e ricollegarla.</translation>
    </message>
    <message>
        <source>angles from a table</source>
        <translation>angoli da una tabella</translation>
    </message>
    <message>
        <source>angles from {format}</source>
        <translation>angoli da {format}</translation>
    </message>
    <message>
        <source>no limits, so the default limits apply</source>
        <translation>nessun limite; valgono quelli predefiniti</translation>
    </message>
    <message>
        <source>no marker {name}</source>
        <translation>manca il marcatore {name}</translation>
    </message>
    <message>
        <source>no frame {number}</source>
        <translation>manca il fotogramma {number}</translation>
    </message>
    <message>
        <source>no saved blue spots</source>
        <translation>nessun punto blu salvato</translation>
    </message>
    <message>
        <source>folder not writable</source>
        <translation>cartella non scrivibile</translation>
    </message>
    <message>
        <source>process ended</source>
        <translation>processo terminato</translation>
    </message>
    <message>
        <source>marker set {subject}</source>
        <translation>insieme di marcatori {subject}</translation>
    </message>
    <message>
        <source>points from {format}</source>
        <translation>punti da {format}</translation>
    </message>
    <message>
        <source>{folder}, created at the first recording</source>
        <translation>{folder}, creata alla prima registrazione</translation>
    </message>
    <message>
        <source>The language can be changed once no measurement or analysis is running.</source>
        <translation>La lingua si può cambiare quando non è in corso nessuna misurazione o analisi.</translation>
    </message>
    <message>
        <source>invisible character</source>
        <translation>carattere invisibile</translation>
    </message>
    <message>
        <source>Manual</source>
        <translation>Manuale</translation>
    </message>
    <message>
        <source>0° = neutral position</source>
        <translation>0° = posizione neutra</translation>
    </message>
    <message>
        <source>Neutral</source>
        <translation>Neutro</translation>
    </message>
    <message>
        <source>Ab-/adduction</source>
        <translation>Ab-/adduzione</translation>
    </message>
    <message>
        <source>Their sessions stay separate.</source>
        <translation>Le loro sedute restano separate.</translation>
    </message>
    <message>
        <source>Hide or show names</source>
        <translation>Nascondi o mostra i nomi</translation>
    </message>
    <message>
        <source>born {day}</source>
        <translation>nascita: {day}</translation>
    </message>
    <message>
        <source>No. {number}</source>
        <translation>N. {number}</translation>
    </message>
    <message>
        <source>female</source>
        <translation>femmina</translation>
    </message>
    <message>
        <source>male</source>
        <translation>maschio</translation>
    </message>
    <message>
        <source>Connect the expected camera. Measurement and recording then continue automatically.</source>
        <translation>Collegare la telecamera attesa. Misurazione e registrazione riprendono poi automaticamente.</translation>
    </message>
    <message>
        <source>Plug the camera in again. Measurement and recording then continue automatically.</source>
        <translation>Ricollegare la telecamera. Misurazione e registrazione riprendono poi automaticamente.</translation>
    </message>
    <message>
        <source>no colour images of {width} × {height} pixels</source>
        <translation>nessuna immagine a colori di {width} × {height} pixel</translation>
    </message>
    <message>
        <source>no depth</source>
        <translation>nessuna profondità</translation>
    </message>
    <message>
        <source>no frames for {seconds} s</source>
        <translation>nessun fotogramma da {seconds} s</translation>
    </message>
    <message>
        <source>unplugged</source>
        <translation>scollegata</translation>
    </message>
    <message>
        <source>“carpus doctor” shows how to grant it.</source>
        <translation>“carpus doctor” mostra come concederlo.</translation>
    </message>
    <message>
        <source>“carpus doctor” shows what is missing and how to install it.</source>
        <translation>“carpus doctor” mostra che cosa manca e come installarlo.</translation>
    </message>
    <message>
        <source>{detail} in the session folder cannot be read and were ignored: {subject}.</source>
        <translation>{detail} nella cartella delle sedute non possono essere letti e sono stati ignorati: {subject}.</translation>
    </message>
    <message>
        <source>{name} is plugged in, but the driver does not see it</source>
        <translation>{name} è collegata, ma il driver non la vede</translation>
    </message>
    <message>
        <source>Remove files that do not belong to Carpus, or choose another disk.</source>
        <translation>Rimuovere file che non appartengono a Carpus, o scegliere un altro disco.</translation>
    </message>
    <message>
        <source>no fonts of Carpus</source>
        <translation>nessun carattere di Carpus</translation>
    </message>
    <message>
        <source>camera clock {own_s} s, computer clock {here_s} s</source>
        <translation>orologio della telecamera {own_s} s, del computer {here_s} s</translation>
    </message>
    <message>
        <source>unknown character set {number}</source>
        <translation>set di caratteri sconosciuto {number}</translation>
    </message>
    <message>
        <source>no record type at the start</source>
        <translation>manca il tipo di record all’inizio</translation>
    </message>
    <message>
        <source>record type {number}, 6302 or 6301 expected</source>
        <translation>tipo di record {number}, atteso 6302 o 6301</translation>
    </message>
    <message>
        <source>no patient number</source>
        <translation>manca il numero del paziente</translation>
    </message>
    <message>
        <source>end missing</source>
        <translation>manca la fine</translation>
    </message>
    <message>
        <source>line {number}: length differs from the stated one</source>
        <translation>riga {number}: lunghezza diversa da quella dichiarata</translation>
    </message>
    <message>
        <source>line {number} is not a GDT line</source>
        <translation>la riga {number} non è una riga GDT</translation>
    </message>
    <message>
        <source>other</source>
        <translation>altro</translation>
    </message>
    <message>
        <source>Waiting patients: {count}.</source>
        <translation>Pazienti in attesa: {count}.</translation>
    </message>
    <message>
        <source>Results can be written.</source>
        <translation>I risultati possono essere scritti.</translation>
    </message>
    <message>
        <source>A folder cannot be used: {reason}</source>
        <translation>Una cartella non può essere usata: {reason}</translation>
    </message>
    <message>
        <source>{count} pairs of one session, compared with {kind}</source>
        <translation>{count} coppie di una seduta, rispetto a: {kind}</translation>
    </message>
    <message>
        <source>{count} joint angles whose names differ from {name}</source>
        <translation>{count} angoli articolari con nomi diversi da quelli di {name}</translation>
    </message>
    <message>
        <source>{wrong}, not supported for an image folder</source>
        <translation>{wrong}, non supportato per una cartella di immagini</translation>
    </message>
    <message>
        <source>Backups cannot be saved there: {subject} ({detail}).</source>
        <translation>Le copie di sicurezza non possono essere salvate lì: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>Pain, note</source>
        <translation>Dolore, nota</translation>
    </message>
    <message>
        <source>{count} per movement, {seconds} s in total</source>
        <translation>{count} per movimento, {seconds} s in tutto</translation>
    </message>
    <message>
        <source>revision {digest}</source>
        <translation>revisione {digest}</translation>
    </message>
    <message>
        <source>In the middle of the nail.</source>
        <translation>Al centro dell’unghia.</translation>
    </message>
    <message>
        <source>{share} % of the repetition time</source>
        <translation>{share} % del tempo delle ripetizioni</translation>
    </message>
    <message>
        <source>Measured on {date} with {count} people in {sessions} sessions. 95 % confidence intervals are in brackets.</source>
        <translation>Misurato in data {date} con {count} persone in {sessions} sedute. Fra parentesi gli intervalli di confidenza al 95 %.</translation>
    </message>
    <message>
        <source>Forearm pronation and supination are measured from thumb up (0°). Palm flat on the table is 90° pronation.</source>
        <translation>Pronazione e supinazione dell’avambraccio si misurano dal pollice in alto (0°). Il palmo piatto sul tavolo corrisponde a 90° di pronazione.</translation>
    </message>
    <message>
        <source>Save the report as a PDF. It contains only the pseudonym.</source>
        <translation>Salvare la relazione in PDF. Contiene solo lo pseudonimo.</translation>
    </message>
    <message>
        <source>A recording still on this computer belonged to a deleted patient and was deleted as well.</source>
        <translation>Una registrazione ancora su questo computer era di un paziente eliminato ed è stata eliminata anch’essa.</translation>
    </message>
    <message>
        <source>A required Python package is not installed: {subject}.</source>
        <translation>Un pacchetto Python necessario non è installato: {subject}.</translation>
    </message>
    <message>
        <source>Another Carpus program is using this data folder: {subject}.</source>
        <translation>Un altro programma Carpus sta usando questa cartella dei dati: {subject}.</translation>
    </message>
    <message>
        <source>Ask your IT support to replace the link with its target, then delete again.</source>
        <translation>Chiedere al supporto informatico di sostituire il collegamento con ciò a cui porta, poi eliminare di nuovo.</translation>
    </message>
    <message>
        <source>On the command line, set it with --camera.</source>
        <translation>Da riga di comando si indica con --camera.</translation>
    </message>
    <message>
        <source>This line must be 100 mm long. If it is not,</source>
        <translation>Questa linea deve essere lunga 100 mm. Se non lo è,</translation>
    </message>
    <message>
        <source>The camera cannot measure the depth at a marker: {subject}.</source>
        <translation>La telecamera non riesce a misurare la profondità di un marcatore: {subject}.</translation>
    </message>
    <message>
        <source>The camera cannot measure the depth at the {markers}.</source>
        <translation>La telecamera non riesce a misurare la profondità di: {markers}.</translation>
    </message>
    <message>
        <source>The session and the reference were not changed.</source>
        <translation>La seduta e il riferimento non sono stati modificati.</translation>
    </message>
    <message>
        <source>a colour image instead of a 16-bit depth image</source>
        <translation>a colori, ma serve un’immagine di profondità a 16 bit</translation>
    </message>
    <message>
        <source>a depth image of {value} bits instead of 16</source>
        <translation>{value} bit, ma serve un’immagine di profondità a 16 bit</translation>
    </message>
    <message>
        <source>a grey image instead of a colour image</source>
        <translation>in grigio, ma serve un’immagine a colori</translation>
    </message>
    <message>
        <source>format version {version}, but this version of Carpus reads up to {format_version}</source>
        <translation>versione del formato {version}, ma questa versione di Carpus legge fino a {format_version}</translation>
    </message>
    <message>
        <source>format version {version}, but this version of Carpus reads {newest}</source>
        <translation>versione del formato {version}, ma questa versione di Carpus legge {newest}</translation>
    </message>
    <message>
        <source>line {line}: there is no angle called {said}</source>
        <translation>riga {line}: nessun angolo si chiama {said}</translation>
    </message>
    <message>
        <source>not in a recording format that Carpus can read</source>
        <translation>non in un formato di registrazione leggibile da Carpus</translation>
    </message>
    <message>
        <source>not tracked with the Carpus filter</source>
        <translation>non analizzata con il filtro di Carpus</translation>
    </message>
    <message>
        <source>unknown angle name, or angle of the other hand</source>
        <translation>nome di angolo sconosciuto o angolo dell’altra mano</translation>
    </message>
    <message>
        <source>unknown marker name, marker of the other hand, or never visible</source>
        <translation>nome di marcatore sconosciuto, marcatore dell’altra mano o mai visibile</translation>
    </message>
    <message>
        <source>version {version}, but this version of Carpus reads up to {count}</source>
        <translation>versione {version}, ma questa versione di Carpus legge fino a {count}</translation>
    </message>
    <message>
        <source>{bits} bits per colour instead of 8</source>
        <translation>{bits} bit per colore invece di 8</translation>
    </message>
    <message>
        <source>{capacity} rows not yet written</source>
        <translation>{capacity} righe non ancora scritte</translation>
    </message>
    <message>
        <source>{name}, outward</source>
        <translation>{name}, andata</translation>
    </message>
    <message>
        <source>{name}, return</source>
        <translation>{name}, ritorno</translation>
    </message>
    <message>
        <source>invalid birth date</source>
        <translation>data di nascita non valida</translation>
    </message>
    <message>
        <source>rotation from the start, + = thumb side up</source>
        <translation>rotazione dall’inizio, + = lato del pollice in alto</translation>
    </message>
    <message>
        <source>from the start, + = thumb side up; {within}</source>
        <translation>dall’inizio, + = pollice in alto; {within}</translation>
    </message>
    <message>
        <source>{finger}, TAM</source>
        <translation>{finger}, TAM</translation>
    </message>
    <message>
        <source>{finger}, fingertip to palm</source>
        <translation>{finger}, distanza polpa-palmo</translation>
    </message>
    <message>
        <source>Finger joints, goniometer (°)</source>
        <translation>Articolazioni delle dita, goniometro (°)</translation>
    </message>
    <message>
        <source>Enter a number from {least} to {most}, or leave it empty</source>
        <translation>Inserire un numero da {least} a {most}, o lasciare vuoto</translation>
    </message>
    <message>
        <source>removed</source>
        <translation>rimosso</translation>
    </message>
    <message>
        <source>Previous entries for this day:</source>
        <translation>Inserimenti precedenti per questo giorno:</translation>
    </message>
    <message>
        <source>Kapandji score</source>
        <translation>Indice di Kapandji</translation>
    </message>
    <message>
        <source>Patient</source>
        <translation>Paziente</translation>
    </message>
    <message>
        <source>Diagnosis or operation</source>
        <translation>Diagnosi o intervento</translation>
    </message>
    <message>
        <source>Last session</source>
        <translation>Ultima seduta</translation>
    </message>
    <message>
        <source>About half-way the PIP joints are occluded. Their range is a minimum value (≥).</source>
        <translation>A circa metà del movimento le articolazioni IFP sono nascoste. La loro escursione è un valore minimo (≥).</translation>
    </message>
    <message>
        <source>At the end of a fist the PIP and DIP joints are occluded. Their ranges are minimum values (≥).</source>
        <translation>Alla fine del pugno le articolazioni IFP e IFD sono nascoste. Le loro escursioni sono valori minimi (≥).</translation>
    </message>
    <message>
        <source>Below about 25° of pronation the markers are occluded. Only the visible part is measured.</source>
        <translation>Sotto circa 25° di pronazione i marcatori sono nascosti. Si misura solo la parte visibile.</translation>
    </message>
    <message>
        <source>Occluded joints are not measured.</source>
        <translation>Le articolazioni nascoste non si misurano.</translation>
    </message>
    <message>
        <source>The abduction of a flexed finger is unreliable. Keep the fingers straight.</source>
        <translation>L’abduzione di un dito flesso non è affidabile. Tenere le dita estese.</translation>
    </message>
    <message>
        <source>Under the palm the thumb tip is occluded. Palmar abduction of the thumb stays visible.</source>
        <translation>Sotto il palmo la punta del pollice è nascosta. L’abduzione palmare del pollice resta visibile.</translation>
    </message>
    <message>
        <source>Exercise</source>
        <translation>Esercizio</translation>
    </message>
    <message>
        <source>Value</source>
        <translation>Valore</translation>
    </message>
    <message>
        <source>Analysed</source>
        <translation>Usate</translation>
    </message>
    <message>
        <source>no opposition</source>
        <translation>nessuna opposizione</translation>
    </message>
    <message>
        <source>index finger, side of the middle phalanx</source>
        <translation>indice, lato della falange media</translation>
    </message>
    <message>
        <source>index finger, side of the distal phalanx</source>
        <translation>indice, lato della falange distale</translation>
    </message>
    <message>
        <source>tip of the index finger</source>
        <translation>punta dell’indice</translation>
    </message>
    <message>
        <source>tip of the middle finger</source>
        <translation>punta del medio</translation>
    </message>
    <message>
        <source>tip of the ring finger</source>
        <translation>punta dell’anulare</translation>
    </message>
    <message>
        <source>tip of the little finger</source>
        <translation>punta del mignolo</translation>
    </message>
    <message>
        <source>little finger, DIP crease</source>
        <translation>mignolo, piega IFD</translation>
    </message>
    <message>
        <source>little finger, PIP crease</source>
        <translation>mignolo, piega IFP</translation>
    </message>
    <message>
        <source>little finger, proximal crease</source>
        <translation>mignolo, piega prossimale</translation>
    </message>
    <message>
        <source>distal palmar crease</source>
        <translation>piega palmare distale</translation>
    </message>
    <message>
        <source>The therapist’s comment is on the last {count} pages.</source>
        <translation>Il commento del terapista è nelle ultime {count} pagine.</translation>
    </message>
    <message>
        <source>Curves and repetitions</source>
        <translation>Curve e ripetizioni</translation>
    </message>
    <message>
        <source>Motion page</source>
        <translation>Pagina del movimento</translation>
    </message>
    <message>
        <source>Reliability of the values</source>
        <translation>Affidabilità dei valori</translation>
    </message>
    <message>
        <source>Table</source>
        <translation>Tabella</translation>
    </message>
    <message>
        <source>{value} is unusual. Typical range: {low} to {high}</source>
        <translation>{value} è insolito. Intervallo tipico: da {low} a {high}</translation>
    </message>
    <message>
        <source>The sessions are shown side by side, but not compared.</source>
        <translation>Le sedute sono mostrate affiancate, ma non confrontate.</translation>
    </message>
    <message>
        <source>The image is too dark: add light.</source>
        <translation>L’immagine è troppo scura: aggiungere luce.</translation>
    </message>
    <message>
        <source>Tilt the board less: the camera sees it almost edge-on.</source>
        <translation>Inclinare meno la tavola: si vede quasi di taglio.</translation>
    </message>
    <message>
        <source>The image is blurred: hold the board still, or add light.</source>
        <translation>L’immagine non è nitida: tenere ferma la tavola o aggiungere luce.</translation>
    </message>
    <message>
        <source>Calculate · more positions and tilts</source>
        <translation>Calcola · più posizioni e inclinazioni</translation>
    </message>
    <message>
        <source>The board is not visible: show the whole board, flat, in even light.</source>
        <translation>Tavola non visibile: mostrarla per intero, ben piana, con luce uniforme.</translation>
    </message>
    <message>
        <source>Depth–colour alignment</source>
        <translation>Allineamento profondità-colore</translation>
    </message>
    <message>
        <source>depth registration is off</source>
        <translation>allineamento profondità-colore non attivo</translation>
    </message>
    <message>
        <source>This camera reports no serial number, so its calibration cannot be saved here. IT support can write it to a camera file with “carpus calibrate-camera --output” and enter that file in the settings.</source>
        <translation>Questa telecamera non comunica un numero di serie, quindi la sua calibrazione non può essere salvata qui. Il supporto informatico può scriverla in un file della telecamera con “carpus calibrate-camera --output” e indicare quel file nelle impostazioni.</translation>
    </message>
    <message>
        <source>Show the next angle as the large number</source>
        <translation>Angolo seguente come numero grande</translation>
    </message>
    <message>
        <source>Show the next finger as the large number</source>
        <translation>Dito seguente come numero grande</translation>
    </message>
    <message>
        <source>Move the start or end of the repetition earlier</source>
        <translation>Anticipa l’inizio o la fine della ripetizione</translation>
    </message>
    <message>
        <source>Move the start or end of the repetition later</source>
        <translation>Posticipa l’inizio o la fine della ripetizione</translation>
    </message>
    <message>
        <source>Zoom in on the curves</source>
        <translation>Ingrandisci le curve</translation>
    </message>
    <message>
        <source>Zoom out of the curves</source>
        <translation>Riduci le curve</translation>
    </message>
    <message>
        <source>Show the whole recording</source>
        <translation>Mostra l’intera registrazione</translation>
    </message>
    <message>
        <source>Select the previous session</source>
        <translation>Seleziona la seduta precedente</translation>
    </message>
    <message>
        <source>Select the next session</source>
        <translation>Seleziona la seduta seguente</translation>
    </message>
    <message>
        <source>Previous frame (correction)</source>
        <translation>Fotogramma precedente (correzione)</translation>
    </message>
    <message>
        <source>Next frame (correction)</source>
        <translation>Fotogramma seguente (correzione)</translation>
    </message>
    <message>
        <source>Undo the last step</source>
        <translation>Annulla l’ultimo passo</translation>
    </message>
    <message>
        <source>Save an image of the hand only</source>
        <translation>Salva un’immagine della sola mano</translation>
    </message>
    <message>
        <source>Tick a session for comparison</source>
        <translation>Seleziona una seduta da confrontare</translation>
    </message>
    <message>
        <source>Show the whole image or only the hand</source>
        <translation>Mostra tutta l’immagine o solo la mano</translation>
    </message>
    <message>
        <source>Open or close the patient’s view</source>
        <translation>Apri o chiudi la vista del paziente</translation>
    </message>
    <message>
        <source>Undo the last click</source>
        <translation>Annulla l’ultimo clic</translation>
    </message>
    <message>
        <source>Swap two labels</source>
        <translation>Scambia due etichette</translation>
    </message>
    <message>
        <source>Click the marker again</source>
        <translation>Rifai il clic sul marcatore</translation>
    </message>
    <message>
        <source>No angle yet</source>
        <translation>Ancora nessun angolo noto</translation>
    </message>
    <message>
        <source>{marker} often occluded</source>
        <translation>Spesso nascosto: {marker}</translation>
    </message>
    <message>
        <source>{count} markers often occluded</source>
        <translation>{count} marcatori spesso nascosti</translation>
    </message>
    <message>
        <source>The line of each finger should run from the wrist to the fingertip. To change a label, drag it to another marker.</source>
        <translation>La linea di ogni dito deve andare dal polso alla punta. Per cambiare un’etichetta, trascinarla su un altro marcatore.</translation>
    </message>
    <message>
        <source>all {count} found</source>
        <translation>trovati tutti ({count})</translation>
    </message>
    <message>
        <source>reading number</source>
        <translation>numero della lettura</translation>
    </message>
    <message>
        <source>mean ± SD of the repetitions</source>
        <translation>media ± DS delle ripetizioni</translation>
    </message>
    <message>
        <source>α and γ are shown only where their SD is below 30° ({share} of the time). Near the neutral position, only β and α + γ can be measured.</source>
        <translation>α e γ sono indicati solo dove la loro DS resta sotto 30° ({share} del tempo): vicino alla posizione neutra si possono determinare solo β e α + γ.</translation>
    </message>
    <message>
        <source>{name}, across the palm</source>
        <translation>{name}, attraverso il palmo</translation>
    </message>
    <message>
        <source>Plausible position while occluded</source>
        <translation>Posizione plausibile quando nascosta</translation>
    </message>
    <message>
        <source>Position known to within 15° while occluded</source>
        <translation>Posizione nota entro 15° quando nascosta</translation>
    </message>
    <message>
        <source>Position jump when visible again</source>
        <translation>Salto di posizione alla ricomparsa</translation>
    </message>
    <message>
        <source>Delay of {other} after {one}</source>
        <translation>Ritardo: {other} dopo {one}</translation>
    </message>
    <message>
        <source>Involuntary movement of {other} with {one}</source>
        <translation>Movimento associato: {other} con {one}</translation>
    </message>
    <message>
        <source>DIP not measured: TAM uses two thirds of the PIP flexion.</source>
        <translation>IFD non misurata: per il TAM si assumono due terzi della flessione IFP.</translation>
    </message>
    <message>
        <source>with the axes of the hand along the path</source>
        <translation>con gli assi della mano lungo il percorso</translation>
    </message>
    <message>
        <source>band: ± 1 SD; black: α + γ</source>
        <translation>fascia: ± 1 DS; nero: α + γ</translation>
    </message>
    <message>
        <source>mean ± SD; right column: {day}</source>
        <translation>media ± DS; colonna destra: {day}</translation>
    </message>
    <message>
        <source>Made with Carpus {version}</source>
        <translation>Prodotto con Carpus {version}</translation>
    </message>
    <message>
        <source>measured with Carpus {versions}</source>
        <translation>misurato con Carpus {versions}</translation>
    </message>
    <message>
        <source>grey: repetitions; band: ± 1 SD of the angle</source>
        <translation>grigio: ripetizioni; fascia: ± 1 DS dell’angolo</translation>
    </message>
    <message>
        <source>marker positions within {size} mm</source>
        <translation>posizioni dei marcatori entro {size} mm</translation>
    </message>
    <message>
        <source>live values, not smoothed</source>
        <translation>valori dal vivo, senza smoothing</translation>
    </message>
    <message>
        <source>repetition {number} excluded: {reason}</source>
        <translation>numero {number} esclusa: {reason}</translation>
    </message>
    <message>
        <source>start or end set manually: repetition {numbers}</source>
        <translation>inizio o fine spostati manualmente: ripetizione {numbers}</translation>
    </message>
    <message>
        <source>as intended: the hand stays straight</source>
        <translation>come previsto: la mano resta in asse</translation>
    </message>
    <message>
        <source>No range of motion could be measured.</source>
        <translation>Nessuna escursione misurabile.</translation>
    </message>
    <message>
        <source>No active range of motion was measured.</source>
        <translation>Nessuna escursione attiva misurata.</translation>
    </message>
    <message>
        <source>Angles in the order deviation, flexion, pronation–supination; {zero}.</source>
        <translation>Angoli nell’ordine deviazione, flessione, prono-supinazione; {zero}.</translation>
    </message>
    <message>
        <source>Angles in the order of the ISB: flexion, deviation, pronation–supination; {zero}.</source>
        <translation>Angoli nell’ordine ISB: flessione, deviazione, prono-supinazione; {zero}.</translation>
    </message>
    <message>
        <source>The wrist angles are in the order of the ISB (flexion first).</source>
        <translation>Gli angoli del polso sono nell’ordine ISB (prima la flessione).</translation>
    </message>
    <message>
        <source>{depth} below the wrist marker (scatter {residual})</source>
        <translation>{depth} sotto il marcatore del polso (dispersione {residual})</translation>
    </message>
    <message>
        <source>Peak speed, mean ± SD</source>
        <translation>Velocità massima, media ± DS</translation>
    </message>
    <message>
        <source>Camera within tolerance: errors up to {angle}° and {length} mm (limits: {most_angle}° and {most_length} mm).</source>
        <translation>Telecamera entro la tolleranza: scarto massimo {angle}° e {length} mm (limiti: {most_angle}° e {most_length} mm).</translation>
    </message>
    <message>
        <source>angles are wrong by {angle}°</source>
        <translation>gli angoli si scostano di {angle}°</translation>
    </message>
    <message>
        <source>Pauses during a movement, mean</source>
        <translation>Pause durante il movimento, media</translation>
    </message>
    <message>
        <source>Largest flexion of each joint; ± is the SD between repetitions.</source>
        <translation>Massima flessione di ogni articolazione; ± è la DS fra le ripetizioni.</translation>
    </message>
    <message>
        <source>Hand exercises at home</source>
        <translation>Esercizi per la mano a casa</translation>
    </message>
    <message>
        <source>Tick the box of the day when you have done all its exercises.</source>
        <translation>Segni la casella del giorno quando ha fatto tutti gli esercizi.</translation>
    </message>
    <message>
        <source>Turn your palm up, then down. Keep your elbow at your side.</source>
        <translation>Girare il palmo in su, poi in giù. Il gomito resta al fianco.</translation>
    </message>
    <message>
        <source>Notes and questions for your next appointment</source>
        <translation>Note e domande per il prossimo appuntamento</translation>
    </message>
    <message>
        <source>Movement in the other directions</source>
        <translation>Movimento nelle altre direzioni</translation>
    </message>
    <message>
        <source>Grades of finger motion</source>
        <translation>Valutazione della mobilità delle dita</translation>
    </message>
    <message>
        <source>Check the camera again: a check is due once a week.</source>
        <translation>Controllare di nuovo la telecamera: va controllata una volta alla settimana.</translation>
    </message>
    <message>
        <source>Saved for the camera with serial number {serial}. Values of earlier sessions do not change.</source>
        <translation>Salvata per la telecamera con numero di serie {serial}. I valori delle sedute precedenti non cambiano.</translation>
    </message>
    <message>
        <source>Positions: {count} of {all} fields ({least} needed)</source>
        <translation>Posizioni: {count} riquadri su {all} (ne servono {least})</translation>
    </message>
    <message>
        <source>Show the board in other positions and at other tilts</source>
        <translation>Mostrare la tavola in altre posizioni, con altre inclinazioni</translation>
    </message>
    <message>
        <source>Correction not kept for {names}. Correct a later frame too.</source>
        <translation>Correzione non mantenuta: {names}. Correggere anche un fotogramma successivo.</translation>
    </message>
    <message>
        <source>Image taken. Move the board to another position.</source>
        <translation>Immagine acquisita. Spostare la tavola in un’altra posizione.</translation>
    </message>
    <message>
        <source>Nothing was changed. Turn on depth registration in the camera settings.</source>
        <translation>Non è stato modificato nulla. Attivare l’allineamento profondità-colore nelle impostazioni della telecamera.</translation>
    </message>
    <message>
        <source>too few images with depth values of the board</source>
        <translation>troppo poche immagini con valori di profondità sulla tavola</translation>
    </message>
    <message>
        <source>mean of Carpus and reference · one point every 0.2 s, {count} points</source>
        <translation>media di Carpus e riferimento · un punto ogni 0,2 s, {count} punti</translation>
    </message>
    <message>
        <source>mean of Carpus and reference · one point per reading, {count} readings</source>
        <translation>media di Carpus e riferimento · un punto per lettura, {count} letture</translation>
    </message>
    <message>
        <source>Correlation of flexion, {one}–{other} (r)</source>
        <translation>Correlazione della flessione, {one}–{other} (r)</translation>
    </message>
    <message>
        <source>Marker labels were corrected manually. The original result is kept.</source>
        <translation>Le etichette dei marcatori sono state corrette manualmente. Il risultato originale è conservato.</translation>
    </message>
    <message>
        <source>Measured manually, not by Carpus: {values}.</source>
        <translation>Misurati manualmente, non da Carpus: {values}.</translation>
    </message>
    <message>
        <source>each movement was shorter than 0.4 s</source>
        <translation>ogni movimento è durato meno di 0,4 s</translation>
    </message>
    <message>
        <source>This clinic measured the MDC95 (measurement error) on {date} with {count} people. Where it was not measured, Carpus uses an expert default. The MDC applies to the same markers, side and set-up.</source>
        <translation>Questo centro ha misurato l’MDC95 (errore di misura) in data {date} con {count} persone. Dove non è stata misurata, Carpus usa un valore predefinito stabilito da esperti. L’MDC vale a parità di marcatori, lato e preparazione.</translation>
    </message>
    <message>
        <source>Until the clinic has measured its own MDC (measurement error), Carpus uses an expert default, not a published value. For a total arc, which has two ends, the MDC is √2 times as large. It applies to the same markers, side and set-up.</source>
        <translation>Finché il centro non ha misurato la propria MDC (errore di misura), Carpus usa un valore predefinito stabilito da esperti, non pubblicato. Per un arco totale, che ha due estremi, l’MDC è √2 volte più grande. Vale a parità di marcatori, lato e preparazione.</translation>
    </message>
    <message>
        <source>{sign}: manual measurement of that day, active / passive. It is not combined with the other values.</source>
        <translation>{sign}: misura manuale di quel giorno, attiva / passiva. Non si combina con gli altri valori.</translation>
    </message>
    <message>
        <source>Check the camera once more, then calibrate it. If it is still out of tolerance, do not measure with it.</source>
        <translation>Controllare ancora una volta la telecamera, poi calibrarla. Se è ancora fuori tolleranza, non misurare con essa.</translation>
    </message>
    <message>
        <source>{movement} {goal} (mean {mean}; beyond measurement error from {limit})</source>
        <translation>{movement} {goal} (media {mean}; oltre l’errore di misura da {limit})</translation>
    </message>
    <message>
        <source>all lengths are {share} % too long, by up to {length} mm</source>
        <translation>tutte le lunghezze sono troppo lunghe ({share} %, errore fino a {length} mm)</translation>
    </message>
    <message>
        <source>all lengths are {share} % too short, by up to {length} mm</source>
        <translation>tutte le lunghezze sono troppo corte ({share} %, errore fino a {length} mm)</translation>
    </message>
    <message>
        <source>{name}, mean ± SD</source>
        <translation>{name}, media ± DS</translation>
    </message>
    <message>
        <source>Show speeds or angles</source>
        <translation>Mostra velocità o angoli</translation>
    </message>
    <message>
        <source>Percentage of the other hand’s TAM or, if not known, of the reference value of 260° (thumb 140°). ASSH: excellent from 100 %, good above 75 %, fair above 50 %, otherwise poor.</source>
        <translation>Percentuale del TAM dell’altra mano o, se non è noto, del valore di riferimento di 260° (pollice 140°). ASSH: ottimo da 100 %, buono oltre 75 %, discreto oltre 50 %, altrimenti scarso.</translation>
    </message>
    <message>
        <source>Check the camera again: it has been calibrated since the last check.</source>
        <translation>Controllare di nuovo la telecamera: dopo l’ultimo controllo è stata calibrata.</translation>
    </message>
    <message>
        <source>Tip to
palm, cm</source>
        <translation>polpa–palmo
cm</translation>
    </message>
    <message>
        <source>{hand}, %</source>
        <translation>{hand}, %</translation>
    </message>
    <message>
        <source>Reference (age group)</source>
        <translation>Riferimento (fascia d’età)</translation>
    </message>
    <message>
        <source>65 to 85 years</source>
        <translation>da 65 a 85 anni</translation>
    </message>
    <message>
        <source>Reference: {source}; {ages}, {sexes}.</source>
        <translation>Riferimento: {source}; {ages}, {sexes}.</translation>
    </message>
    <message>
        <source>Walker 1984, 60 people (active, goniometer)</source>
        <translation>Walker 1984, 60 persone (attivo, goniometro)</translation>
    </message>
    <message>
        <source>men</source>
        <translation>uomini</translation>
    </message>
    <message>
        <source>In the middle of the back of the wrist, in the small hollow.</source>
        <translation>Al centro del dorso del polso, nella piccola fossetta.</translation>
    </message>
    <message>
        <source>Another blue spot fits the {markers} better than the clicked one.</source>
        <translation>Un altro punto blu corrisponde meglio a: {markers}.</translation>
    </message>
    <message>
        <source>Click the centre of the marker again, and keep the hand still.</source>
        <translation>Fare di nuovo clic al centro del marcatore e tenere ferma la mano.</translation>
    </message>
    <message>
        <source>Click the centre of the {markers} again, or cover the other spot.</source>
        <translation>Fare di nuovo clic al centro ({markers}), o coprire l’altro punto.</translation>
    </message>
    <message>
        <source>Cover the spot with the question mark, or give it the correct label.</source>
        <translation>Coprire il punto con il punto interrogativo, o dargli l’etichetta giusta.</translation>
    </message>
    <message>
        <source>The {markers} does not fit the other markers: no hand has this shape.</source>
        <translation>Nessuna mano ha questa forma: un marcatore non è compatibile con gli altri ({markers}).</translation>
    </message>
    <message>
        <source>The camera is connected again: {subject} (disconnected for {detail}).</source>
        <translation>La telecamera è di nuovo collegata: {subject} (scollegata per {detail}).</translation>
    </message>
    <message>
        <source>The hand length is {value} mm (the limit is {limit} mm).</source>
        <translation>La lunghezza della mano è di {value} mm (limite: {limit} mm).</translation>
    </message>
    <message>
        <source>The hand length is {value} mm. Last time it was {limit} mm.</source>
        <translation>La lunghezza della mano è di {value} mm. L’ultima volta era di {limit} mm.</translation>
    </message>
    <message>
        <source>The hand was still for only {value} frames ({limit} or more are good).</source>
        <translation>La mano è stata ferma solo per {value} fotogrammi ({limit} o più vanno bene).</translation>
    </message>
    <message>
        <source>The pseudonym {subject} belongs to another patient.</source>
        <translation>Lo pseudonimo {subject} appartiene a un altro paziente.</translation>
    </message>
    <message>
        <source>The labels seem to be shifted: the marker clicked as {first} is probably the {second}.</source>
        <translation>Le etichette sembrano spostate: il marcatore indicato come {first} è probabilmente {second}.</translation>
    </message>
    <message>
        <source>The Dask scheduler at {subject} does not respond ({detail}).</source>
        <translation>Lo scheduler Dask all’indirizzo {subject} non risponde ({detail}).</translation>
    </message>
    <message>
        <source>This camera does not align depth with colour, so depths at the markers will be wrong.</source>
        <translation>Questa telecamera non allinea la profondità al colore, quindi la profondità dei marcatori è errata.</translation>
    </message>
    <message>
        <source>Unplug the camera, plug it in again, then restart the measurement.</source>
        <translation>Scollegare la telecamera, ricollegarla e riavviare la misurazione.</translation>
    </message>
    <message>
        <source>Use a C3D, TRC or MOT file, a CSV table with its column map, or a session.</source>
        <translation>Usare un file C3D, TRC o MOT, una tabella CSV con la mappa delle colonne, o una seduta.</translation>
    </message>
    <message>
        <source>Use a camera with colour and depth, such as the Asus Xtion.</source>
        <translation>Usare una telecamera con colore e profondità, come la Asus Xtion.</translation>
    </message>
    <message>
        <source>Use the marker set wrist6 or hand21.</source>
        <translation>Usare l’insieme di marcatori wrist6 o hand21.</translation>
    </message>
    <message>
        <source>damaged: a name in it is not text</source>
        <translation>danneggiato: contiene un nome che non è un testo</translation>
    </message>
    <message>
        <source>all six markers visible in {count} of {looked} frames</source>
        <translation>tutti i sei marcatori visibili in {count} fotogrammi su {looked}</translation>
    </message>
    <message>
        <source>{count} bytes after the end of the recording</source>
        <translation>{count} byte dopo la fine della registrazione</translation>
    </message>
    <message>
        <source>damaged: the end cannot be read</source>
        <translation>danneggiato: la fine non è leggibile</translation>
    </message>
    <message>
        <source>damaged: Carpus could not finish reading it</source>
        <translation>danneggiato: lettura non completata</translation>
    </message>
    <message>
        <source>the focal length is uncertain by {share} %</source>
        <translation>l’incertezza della distanza focale è {share} %</translation>
    </message>
    <message>
        <source>this setting does not exist (file {file})</source>
        <translation>questa impostazione non esiste (file {file})</translation>
    </message>
    <message>
        <source>The labels of {markers} seem to be swapped.</source>
        <translation>Le etichette sembrano scambiate: {markers}.</translation>
    </message>
    <message>
        <source>damaged: the calibration in it does not describe a hand</source>
        <translation>danneggiata: la calibrazione non descrive una mano</translation>
    </message>
    <message>
        <source>A recording ended before its first second was saved, so it cannot be recovered: {subject}.</source>
        <translation>Una registrazione è terminata prima che fosse salvato il primo secondo e non si può recuperare: {subject}.</translation>
    </message>
    <message>
        <source>A session that was saved on this computer is now in the session folder: {subject}.</source>
        <translation>Una seduta salvata su questo computer è ora nella cartella delle sedute: {subject}.</translation>
    </message>
    <message>
        <source>All sessions are safe. Your last entries may not be saved.</source>
        <translation>Tutte le sedute sono al sicuro. Gli ultimi dati inseriti potrebbero non essere salvati.</translation>
    </message>
    <message>
        <source>Back up to another disk now, and replace the faulty disk.</source>
        <translation>Eseguire subito una copia di sicurezza su un altro disco, e sostituire il disco difettoso.</translation>
    </message>
    <message>
        <source>Check that the reference shows the same movement, and state which column or marker is which.</source>
        <translation>Controllare che il riferimento mostri lo stesso movimento, e indicare a che cosa corrisponde ogni colonna o marcatore.</translation>
    </message>
    <message>
        <source>Check that the folder exists and that you are allowed to write to it, or choose another folder.</source>
        <translation>Controllare che la cartella esista e che vi si possa scrivere, o sceglierne un’altra.</translation>
    </message>
    <message>
        <source>Check the address of the scheduler.</source>
        <translation>Controllare l’indirizzo dello scheduler.</translation>
    </message>
    <message>
        <source>Close the other window or program, then try again.</source>
        <translation>Chiudere l’altra finestra o l’altro programma, poi riprovare.</translation>
    </message>
    <message>
        <source>Close other programs that use these files, then restart Carpus.</source>
        <translation>Chiudere gli altri programmi che usano questi file, poi riavviare Carpus.</translation>
    </message>
    <message>
        <source>Continue measuring. The gap is marked in the session.</source>
        <translation>Continuare a misurare. La lacuna è indicata nella seduta.</translation>
    </message>
    <message>
        <source>Continue measuring. When the disk or network is available again, Carpus moves the session automatically.</source>
        <translation>Continuare a misurare. Quando il disco o la rete tornano disponibili, Carpus sposta la seduta automaticamente.</translation>
    </message>
    <message>
        <source>Copy the recording again from its source, or correct its list of frames.</source>
        <translation>Copiare di nuovo la registrazione dall’origine, o correggere il suo elenco di fotogrammi.</translation>
    </message>
    <message>
        <source>Everything saved before is safe. The data that Carpus was writing may be missing.</source>
        <translation>Tutto ciò che era già salvato è al sicuro. I dati che Carpus stava scrivendo possono mancare.</translation>
    </message>
    <message>
        <source>Glue the board onto something stiff and flat, use good light, and hold the board still.</source>
        <translation>Incollare la tavola su qualcosa di rigido e piano, illuminarla bene e tenerla ferma.</translation>
    </message>
    <message>
        <source>To use another pseudonym, edit the patient.</source>
        <translation>Per usare un altro pseudonimo, modificare il paziente.</translation>
    </message>
    <message>
        <source>If you copied the file, copy it again. Otherwise restore it from a backup.</source>
        <translation>Se il file è stato copiato, copiarlo di nuovo. Altrimenti ripristinarlo da una copia di sicurezza.</translation>
    </message>
    <message>
        <source>If the units are wrong, correct the list of frames or state the unit of depth.</source>
        <translation>Se le unità sono errate, correggere l’elenco dei fotogrammi o indicare l’unità della profondità.</translation>
    </message>
    <message>
        <source>The session can be opened, but its values may have been altered.</source>
        <translation>La seduta può essere aperta, ma i suoi valori possono essere stati alterati.</translation>
    </message>
    <message>
        <source>The session is complete.</source>
        <translation>La seduta è completa.</translation>
    </message>
    <message>
        <source>{subject} does not state whether depth and colour are aligned. Carpus assumes that they are.</source>
        <translation>{subject} non indica se profondità e colore sono allineati. Carpus presume di sì.</translation>
    </message>
    <message>
        <source>The session is safe on this computer.</source>
        <translation>La seduta è al sicuro su questo computer.</translation>
    </message>
    <message>
        <source>The SHA-256 checksum of the file does not match.</source>
        <translation>La somma di controllo SHA-256 del file non corrisponde.</translation>
    </message>
    <message>
        <source>Measure a session, or choose the folder that contains the sessions.</source>
        <translation>Misurare una seduta, o scegliere la cartella che contiene le sedute.</translation>
    </message>
    <message>
        <source>You do not need to do anything.</source>
        <translation>Non occorre fare nulla.</translation>
    </message>
    <message>
        <source>There is no camera calibration for {subject}, so lengths may be wrong by several per cent ({detail}).</source>
        <translation>Per {subject} non c’è una calibrazione della telecamera, quindi le lunghezze possono essere errate di alcuni punti percentuali ({detail}).</translation>
    </message>
    <message>
        <source>Nothing is lost. Names, images and values stay hidden.</source>
        <translation>Non è andato perso nulla. Nomi, immagini e valori restano nascosti.</translation>
    </message>
    <message>
        <source>Open the record again and enter your change once more.</source>
        <translation>Riaprire la scheda e inserire di nuovo la modifica.</translation>
    </message>
    <message>
        <source>Restart Carpus to recover what can still be read. If names are missing, restore a backup.</source>
        <translation>Riavviare Carpus per recuperare ciò che è ancora leggibile. Se mancano nomi, ripristinare una copia di sicurezza.</translation>
    </message>
    <message>
        <source>Restore these files from a backup.</source>
        <translation>Ripristinare questi file da una copia di sicurezza.</translation>
    </message>
    <message>
        <source>Show the board in all parts of the image, tilted to all four sides, near and far. Hold it still.</source>
        <translation>Mostrare la tavola in ogni parte dell’immagine, inclinata sui quattro lati, vicina e lontana. Tenerla ferma.</translation>
    </message>
    <message>
        <source>Some images are smaller than the others and were enlarged: {subject} ({detail}).</source>
        <translation>Alcune immagini sono più piccole delle altre e sono state ingrandite: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>State in the camera file whether depth and colour are aligned.</source>
        <translation>Indicare nel file della telecamera se profondità e colore sono allineati.</translation>
    </message>
    <message>
        <source>The backup is incomplete: {subject} is missing or cannot be read ({detail} in total).</source>
        <translation>La copia di sicurezza è incompleta: {subject} manca o non può essere letto (in tutto {detail}).</translation>
    </message>
    <message>
        <source>The backup failed verification: a file in it differs from the original ({subject}, {detail}).</source>
        <translation>La verifica della copia di sicurezza non è riuscita: un suo file è diverso dall’originale ({subject}, {detail}).</translation>
    </message>
    <message>
        <source>The clinic’s server does not respond: {subject} ({detail}).</source>
        <translation>Il server del centro non risponde: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The patient list was created by another version of Carpus: {subject} ({detail}).</source>
        <translation>L’elenco dei pazienti è di un’altra versione di Carpus: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The reference contains nothing that can be compared: {subject} ({detail}).</source>
        <translation>Il riferimento non contiene nulla di confrontabile: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The session folder contains no Carpus data: {subject}.</source>
        <translation>La cartella delle sedute non contiene dati di Carpus: {subject}.</translation>
    </message>
    <message>
        <source>There is no camera type with the name {subject} ({detail}).</source>
        <translation>Non esiste un tipo di telecamera chiamato {subject} ({detail}).</translation>
    </message>
    <message>
        <source>There is no marker set with the name {subject} ({detail}).</source>
        <translation>Non esiste un insieme di marcatori chiamato {subject} ({detail}).</translation>
    </message>
    <message>
        <source>The files are no longer listed. Carpus tries to delete them again at each start.</source>
        <translation>I file non sono più in elenco. A ogni avvio Carpus riprova a eliminarli.</translation>
    </message>
    <message>
        <source>These files were not changed. All other sessions are safe.</source>
        <translation>Questi file non sono stati modificati. Tutte le altre sedute sono al sicuro.</translation>
    </message>
    <message>
        <source>This text cannot be used as a name: {detail} ({subject}).</source>
        <translation>Questo testo non può essere un nome: {detail} ({subject}).</translation>
    </message>
    <message>
        <source>Two patients had the pseudonym {subject}. The second one now has ({detail}) after it.</source>
        <translation>Due pazienti avevano lo pseudonimo {subject}. Il secondo ora è seguito da ({detail}).</translation>
    </message>
    <message>
        <source>Restore the session from a backup.</source>
        <translation>Ripristinare la seduta da una copia di sicurezza.</translation>
    </message>
    <message>
        <source>Wait until the other program has finished, or choose another folder.</source>
        <translation>Attendere che l’altro programma abbia finito, o scegliere un’altra cartella.</translation>
    </message>
    <message>
        <source>Wait until the recording has ended, or restart Carpus to complete the session.</source>
        <translation>Attendere la fine della registrazione, o riavviare Carpus, che completa la seduta.</translation>
    </message>
    <message>
        <source>Everything recorded is safe.</source>
        <translation>Tutto ciò che è stato registrato è al sicuro.</translation>
    </message>
    <message>
        <source>Without the option --scheduler, this computer tracks the recordings.</source>
        <translation>Senza l’opzione --scheduler è questo computer ad analizzare le registrazioni.</translation>
    </message>
    <message>
        <source>You can use the live values of this session.</source>
        <translation>Si possono usare i valori dal vivo di questa seduta.</translation>
    </message>
    <message>
        <source>The unit of depth is depth_unit_m in camera_info.yaml.</source>
        <translation>L’unità della profondità è depth_unit_m in camera_info.yaml.</translation>
    </message>
    <message>
        <source>“carpus calibrate-camera --board” writes the board as a PDF to print.</source>
        <translation>“carpus calibrate-camera --board” crea la tavola da stampare, in PDF.</translation>
    </message>
    <message>
        <source>“carpus recover” also completes the session.</source>
        <translation>Anche “carpus recover” completa la seduta.</translation>
    </message>
    <message>
        <source>not a valid TOML file: too many nested tables</source>
        <translation>non è un file TOML valido: troppe tabelle annidate</translation>
    </message>
    <message>
        <source>on; Carpus corrects it</source>
        <translation>attivo, corretto da Carpus</translation>
    </message>
    <message>
        <source>You can also track the recording again with “carpus track”.</source>
        <translation>Si può anche rianalizzare la registrazione con “carpus track”.</translation>
    </message>
    <message>
        <source>Continue measuring. If the server still does not respond, ask your IT support.</source>
        <translation>Continuare a misurare. Se il server continua a non rispondere, chiedere al supporto informatico.</translation>
    </message>
    <message>
        <source>Lay the card flat under the camera, fully in view, about 60 cm away, in good light.</source>
        <translation>Mettere il cartoncino piatto sotto la telecamera, tutto inquadrato, a circa 60 cm, con buona luce.</translation>
    </message>
    <message>
        <source>“carpus doctor” shows which data folder is used.</source>
        <translation>“carpus doctor” mostra quale cartella dei dati è in uso.</translation>
    </message>
    <message>
        <source>You can also put the file camera_info.yaml of the camera next to the recording.</source>
        <translation>Si può anche mettere il file camera_info.yaml della telecamera accanto alla registrazione.</translation>
    </message>
    <message>
        <source>The MDC values were not changed.</source>
        <translation>I valori MDC non sono stati modificati.</translation>
    </message>
    <message>
        <source>The recording has unusual units, and Carpus converts them: {subject} ({detail}).</source>
        <translation>La registrazione ha unità insolite e Carpus le converte: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>damaged: reading it needs too much memory</source>
        <translation>danneggiato: la lettura richiede troppa memoria</translation>
    </message>
    <message>
        <source>Session files are safe. Do not delete the patient list: no other file has the names and notes.</source>
        <translation>I file delle sedute sono al sicuro. Non eliminare l’elenco dei pazienti: nomi e note si trovano solo lì.</translation>
    </message>
    <message>
        <source>These sessions cannot be used as a test–retest study: {subject} ({detail}).</source>
        <translation>Queste sedute non si possono usare come studio test-retest: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>Thumb contact occluded</source>
        <translation>Contatto del pollice nascosto</translation>
    </message>
    <message>
        <source>Touched {met} of {all} fingertips</source>
        <translation>Toccati {met} polpastrelli su {all}</translation>
    </message>
    <message>
        <source>total arcs in the same period</source>
        <translation>archi totali nello stesso periodo</translation>
    </message>
    <message>
        <source>Duration</source>
        <translation>Durata</translation>
    </message>
    <message>
        <source>{weeks} before this session</source>
        <translation>{weeks} prima di questa seduta</translation>
    </message>
    <message>
        <source>{difference} since first session</source>
        <translation>{difference} rispetto alla prima</translation>
    </message>
    <message>
        <source>Start Carpus from a desktop session. The commands for files work without a screen.</source>
        <translation>Avviare Carpus da un desktop. I comandi per i file funzionano senza schermo.</translation>
    </message>
    <message>
        <source>hand is {json}, but right or left is expected</source>
        <translation>hand è {json}, atteso right o left</translation>
    </message>
    <message>
        <source>side of the wedge with one marker</source>
        <translation>lato del cuneo con un marcatore</translation>
    </message>
    <message>
        <source>session and reference overlap by less than {least_overlap_s} s, or nothing moves</source>
        <translation>seduta e riferimento si sovrappongono per meno di {least_overlap_s} s, o non c’è movimento</translation>
    </message>
    <message>
        <source>line {number} names a file outside the folder: {content}</source>
        <translation>la riga {number} indica un file fuori dalla cartella: {content}</translation>
    </message>
    <message>
        <source>straight_fingers must be five values, true or false, from thumb to little finger</source>
        <translation>straight_fingers deve avere cinque valori, true o false, dal pollice al mignolo</translation>
    </message>
    <message>
        <source>the best match of the curves is only {match}. Check that they show the same movement</source>
        <translation>la migliore concordanza delle curve è solo {match}. Controllare che mostrino lo stesso movimento</translation>
    </message>
    <message>
        <source>session and reference do not overlap in time</source>
        <translation>seduta e riferimento non si sovrappongono nel tempo</translation>
    </message>
    <message>
        <source>side of the wedge with two markers</source>
        <translation>lato del cuneo con due marcatori</translation>
    </message>
    <message>
        <source>{folder}: cannot write to {there}</source>
        <translation>{folder}: in {there} non si può scrivere</translation>
    </message>
    <message>
        <source>{name} is {json}, but two pixel coordinates are expected</source>
        <translation>{name} è {json}, attese due coordinate in pixel</translation>
    </message>
    <message>
        <source>Analysing…</source>
        <translation>Analisi in corso…</translation>
    </message>
    <message>
        <source>Analysing: {seconds} s left</source>
        <translation>Analisi: ancora {seconds} s</translation>
    </message>
    <message>
        <source>the markers of session and reference are {apart} mm apart (expected: up to {most} mm). They may be other markers or another hand, or the markers may jump</source>
        <translation>i marcatori di seduta e riferimento distano {apart} mm (attesi: fino a {most} mm). Forse sono altri marcatori o un’altra mano, oppure i marcatori saltano</translation>
    </message>
    <message>
        <source>Send the patient again from the clinic software, or choose the patient in Carpus.</source>
        <translation>Inviare di nuovo il paziente dal gestionale oppure sceglierlo in Carpus.</translation>
    </message>
    <message>
        <source>The file from the clinic software cannot be read: {subject} ({detail}).</source>
        <translation>Il file del gestionale non può essere letto: {subject} ({detail}).</translation>
    </message>
    <message>
        <source>Time since</source>
        <translation>Da</translation>
    </message>
    <message>
        <source>The cup may occlude the thumb. The results show for how long.</source>
        <translation>Il bicchiere può nascondere il pollice. I risultati indicano per quanto tempo.</translation>
    </message>
    <message>
        <source>Any movement of the forearm is included in the angle.</source>
        <translation>Ogni movimento dell’avambraccio altera l’angolo.</translation>
    </message>
    <message>
        <source>Status</source>
        <translation>Stato</translation>
    </message>
    <message>
        <source>see the next page for the complete list</source>
        <translation>elenco completo nella pagina seguente</translation>
    </message>
    <message>
        <source>Proposed from the last session:</source>
        <translation>Proposta dall’ultima seduta:</translation>
    </message>
    <message>
        <source>Proposed from the last {count} sessions:</source>
        <translation>Proposta dalle ultime {count} sedute:</translation>
    </message>
    <message>
        <source>up to 54 years</source>
        <translation>fino a 54 anni</translation>
    </message>
    <message>
        <source>fingertip to palm {distance}</source>
        <translation>distanza polpa-palmo {distance}</translation>
    </message>
    <message>
        <source>There. Hold still.</source>
        <translation>Ecco. Resti così.</translation>
    </message>
    <message>
        <source>TAM is missing for fingers whose joints were never all visible at once.</source>
        <translation>Il TAM manca per le dita le cui articolazioni non erano mai tutte visibili contemporaneamente.</translation>
    </message>
    <message>
        <source>Hand at the edge of the table. Cup 5 to 7 cm wide, 20 to 30 cm away.</source>
        <translation>Mano sul bordo del tavolo. Bicchiere largo 5–7 cm, a 20–30 cm.</translation>
    </message>
    <message>
        <source>Choose a patient in the list, then start here. The practice patient is simulated.</source>
        <translation>Scegliere un paziente nell’elenco, poi iniziare qui. Il paziente di prova è simulato.</translation>
    </message>
    <message>
        <source>Every marker has its label and all checks are good. Start measuring here.</source>
        <translation>Ogni marcatore ha la sua etichetta e tutti i controlli sono buoni. Iniziare qui la misurazione.</translation>
    </message>
    <message>
        <source>You have finished a whole session. The arrow at the top left leads back to the patients.</source>
        <translation>La seduta è completa. La freccia in alto a sinistra riporta ai pazienti.</translation>
    </message>
    <message>
        <source>The camera needs a USB 2 port: some USB 3 ports refuse cameras with old firmware.</source>
        <translation>La telecamera richiede una porta USB 2: alcune porte USB 3 rifiutano telecamere con firmware vecchio.</translation>
    </message>
    <message>
        <source>This camera sends no time stamps. Carpus uses the time at which each frame arrives, so speeds are approximate.</source>
        <translation>Questa telecamera non invia l’ora di ripresa dei fotogrammi. Carpus usa l’ora di arrivo, quindi le velocità sono approssimative.</translation>
    </message>
    <message>
        <source>unknown file format {value}</source>
        <translation>formato di file sconosciuto {value}</translation>
    </message>
    <message>
        <source>{movement}: the session has no range in this direction, and the list of readings has no time</source>
        <translation>{movement}: la seduta non ha escursione in questa direzione, e l’elenco delle letture non indica il tempo</translation>
    </message>
    <message>
        <source>The backup contains every session.</source>
        <translation>La copia di sicurezza contiene tutte le sedute.</translation>
    </message>
    <message>
        <source>1 session file is missing from the backup.</source>
        <translation>Nella copia di sicurezza manca 1 file di seduta.</translation>
    </message>
    <message>
        <source>{n} session files are missing from the backup.</source>
        <translation>Nella copia di sicurezza mancano {n} file di sedute.</translation>
    </message>
    <message>
        <source>The backup is on the same disk as the data. If that disk fails, both are lost.</source>
        <translation>La copia di sicurezza è sullo stesso disco dei dati. Se il disco si guasta, si perdono entrambi.</translation>
    </message>
    <message>
        <source>You may feel a stretch, but no pain. If your hand still hurts an hour later, do less next time and call us.</source>
        <translation>Può tirare, ma non deve far male. Se dopo un’ora la mano fa ancora male, la prossima volta faccia meno e ci chiami.</translation>
    </message>
    <message>
        <source>the saved data differ from the recorded data</source>
        <translation>i dati salvati sono diversi da quelli registrati</translation>
    </message>
    <message>
        <source>“carpus track --leave-out-damaged” continues without the damaged frames.</source>
        <translation>“carpus track --leave-out-damaged” prosegue senza i fotogrammi danneggiati.</translation>
    </message>
    <message>
        <source>Carpus changed nothing there.</source>
        <translation>Carpus non vi ha modificato nulla.</translation>
    </message>
    <message>
        <source>Reinstall OpenNI2.</source>
        <translation>Reinstallare OpenNI2.</translation>
    </message>
    <message>
        <source>Check that every label is on its marker, then press Enter.</source>
        <translation>Controllare che ogni etichetta sia sul suo marcatore, poi premere Invio.</translation>
    </message>
    <message>
        <source>Boone and Azen 1979, 109 males from 18 months on (active, goniometer)</source>
        <translation>Boone e Azen 1979, 109 maschi dai 18 mesi in su (attivo, goniometro)</translation>
    </message>
</context>
<context>
    <name>AppointmentBox</name>
    <message>
        <source>No appointment yet</source>
        <translation>Ancora nessun appuntamento</translation>
    </message>
    <message>
        <source>Next appointment: day, month, year</source>
        <translation>Prossimo appuntamento: giorno, mese, anno</translation>
    </message>
    <message>
        <source>Next appointment: this day has passed</source>
        <translation>Prossimo appuntamento: giorno già passato</translation>
    </message>
</context>
<context>
    <name>BackupCard</name>
    <message>
        <source>&amp;Back up now</source>
        <translation>&amp;Copia ora</translation>
    </message>
    <message>
        <source>&amp;Restore…</source>
        <translation>&amp;Ripristina…</translation>
    </message>
    <message>
        <source>Change…</source>
        <translation>Cambia…</translation>
    </message>
    <message>
        <source>Backup</source>
        <translation>Copia di sicurezza</translation>
    </message>
    <message>
        <source>Daily at 12:00</source>
        <translation>Alle 12:00</translation>
    </message>
    <message>
        <source>Daily at 18:00</source>
        <translation>Alle 18:00</translation>
    </message>
    <message>
        <source>Manual only</source>
        <translation>Solo manuale</translation>
    </message>
    <message>
        <source>Backup folder</source>
        <translation>Cartella</translation>
    </message>
    <message>
        <source>Keep</source>
        <translation>Conservare</translation>
    </message>
    <message>
        <source>Anyone with the backup disk can read it. Use an encrypted disk.</source>
        <translation>Chi ha il disco può leggere le copie di sicurezza. Usare un disco cifrato.</translation>
    </message>
    <message>
        <source>none</source>
        <translation>nessuna</translation>
    </message>
    <message>
        <source>{percent} %</source>
        <translation>{percent} %</translation>
    </message>
    <message>
        <source>Backs up the whole data folder: patients, sessions, images and log. You can continue measuring.</source>
        <translation>Copia tutta la cartella dei dati: pazienti, sedute, immagini e registro. Nel frattempo si può misurare.</translation>
    </message>
    <message>
        <source>The backup is verified afterwards.</source>
        <translation>Poi la copia viene verificata.</translation>
    </message>
    <message>
        <source>The changes are shown first.</source>
        <translation>Prima si vedono le modifiche.</translation>
    </message>
    <message>
        <source>the last 14 backups, plus one per month for 2 years</source>
        <translation>le ultime 14 copie, più una al mese per 2 anni</translation>
    </message>
    <message>
        <source>Automatic backup</source>
        <translation>Ogni giorno</translation>
    </message>
</context>
<context>
    <name>BackupController</name>
    <message>
        <source>Connect the backup disk and back up.</source>
        <translation>Collegare il disco delle copie di sicurezza ed eseguirne una.</translation>
    </message>
    <message>
        <source>Open settings</source>
        <translation>Apri le impostazioni</translation>
    </message>
    <message>
        <source>Backup folder, on another disk</source>
        <translation>Cartella per le copie di sicurezza, su un altro disco</translation>
    </message>
    <message>
        <source>Folder with the backups</source>
        <translation>Cartella con le copie di sicurezza</translation>
    </message>
    <message>
        <source>{when}: {n} session files</source>
        <translation>{when}: {n} file di sedute</translation>
    </message>
    <message>
        <source>Which backup should be restored?</source>
        <translation>Quale copia di sicurezza va ripristinata?</translation>
    </message>
    <message>
        <source>Carpus shows the changes before it restores anything.</source>
        <translation>Carpus mostra le modifiche prima di ripristinare.</translation>
    </message>
    <message>
        <source>Restore the backup of {when}? Session files added: {come}, changed: {change}, removed: {go}.</source>
        <translation>Ripristinare la copia di sicurezza ({when})? File di sedute aggiunti: {come}, cambiati: {change}, tolti: {go}.</translation>
    </message>
    <message>
        <source>Patients and sessions deleted since then stay deleted: {n}.</source>
        <translation>I pazienti e le sedute eliminati da allora restano eliminati: {n}.</translation>
    </message>
    <message>
        <source>The current data folder is kept next to the restored one.</source>
        <translation>La cartella dei dati attuale resta accanto a quella ripristinata.</translation>
    </message>
    <message>
        <source>Carpus closes afterwards. Start it again then.</source>
        <translation>Al termine Carpus si chiude. Poi avviarlo di nuovo.</translation>
    </message>
    <message>
        <source>Restore</source>
        <translation>Ripristina</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Annulla</translation>
    </message>
    <message>
        <source>Restore…</source>
        <translation>Ripristina…</translation>
    </message>
</context>
<context>
    <name>BoardCaptureView</name>
    <message>
        <source>Stop</source>
        <translation>Interrompi</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>Progress</source>
        <translation>Avanzamento</translation>
    </message>
    <message>
        <source>Images are taken automatically when the board is still, sharp and in a new position.</source>
        <translation>Le immagini vengono acquisite automaticamente quando la tavola è ferma, nitida e in una nuova posizione.</translation>
    </message>
    <message>
        <source>Opening the camera…</source>
        <translation>Apertura della telecamera…</translation>
    </message>
    <message>
        <source>Please wait</source>
        <translation>Attendere</translation>
    </message>
    <message>
        <source>No image yet</source>
        <translation>Ancora nessuna immagine</translation>
    </message>
    <message>
        <source>Hold the board in view</source>
        <translation>Tenere la tavola nell’inquadratura</translation>
    </message>
    <message>
        <source>Show the whole board, facing the camera, about 60 cm away.</source>
        <translation>Mostrare tutta la tavola, rivolta verso la telecamera, a circa 60 cm.</translation>
    </message>
    <message>
        <source>No frames from the camera</source>
        <translation>Nessun fotogramma dalla telecamera</translation>
    </message>
    <message>
        <source>Enough images</source>
        <translation>Immagini sufficienti</translation>
    </message>
    <message>
        <source>Press “Calculate”, or add more images to improve the result.</source>
        <translation>Premere “Calcola”, o aggiungere immagini per migliorare il risultato.</translation>
    </message>
    <message>
        <source>Then hold it still.</source>
        <translation>Poi tenerla ferma.</translation>
    </message>
    <message>
        <source>1 image</source>
        <translation>1 immagine</translation>
    </message>
    <message>
        <source>{count} images</source>
        <translation>{count} immagini</translation>
    </message>
    <message>
        <source>Calculating…</source>
        <translation>Calcolo in corso…</translation>
    </message>
    <message>
        <source>This takes a few seconds. You can put the board down.</source>
        <translation>Richiede alcuni secondi. La tavola si può posare.</translation>
    </message>
</context>
<context>
    <name>BoardResultView</name>
    <message>
        <source>&amp;Repeat</source>
        <translation>&amp;Ripeti</translation>
    </message>
    <message>
        <source>Use this calibration</source>
        <translation>Usa questa calibrazione</translation>
    </message>
</context>
<context>
    <name>BoardSetupView</name>
    <message>
        <source>&amp;Print the board…</source>
        <translation>&amp;Stampa la tavola…</translation>
    </message>
    <message>
        <source>Length of the printed ruler</source>
        <translation>Lunghezza del righello stampato</translation>
    </message>
    <message>
        <source>Start</source>
        <translation>Inizia</translation>
    </message>
    <message>
        <source>Calibrate the camera</source>
        <translation>Calibrare la telecamera</translation>
    </message>
    <message>
        <source>1  Print the board</source>
        <translation>1  Stampare la tavola</translation>
    </message>
    <message>
        <source>Use even light without reflections. The screen shows where to hold the board. Images are taken automatically when it is still, sharp and in a new position. No image is saved, and nothing changes until you confirm.</source>
        <translation>Usare luce uniforme, senza riflessi. Lo schermo indica dove tenere la tavola. Le immagini vengono acquisite automaticamente quando è ferma, nitida e in una nuova posizione. Nessuna immagine viene salvata e nulla cambia prima della conferma.</translation>
    </message>
    <message>
        <source>The camera is connected.</source>
        <translation>La telecamera è collegata.</translation>
    </message>
    <message>
        <source>No camera is connected.</source>
        <translation>Nessuna telecamera è collegata.</translation>
    </message>
    <message>
        <source>Start · connect the camera</source>
        <translation>Inizia · collegare la telecamera</translation>
    </message>
    <message>
        <source>2  Show it to the camera</source>
        <translation>2  Mostrarla alla telecamera</translation>
    </message>
    <message>
        <source>Calibration takes five minutes. It measures the lens, the depth error and the alignment of depth and colour. Do it once for each camera, and again if the camera was knocked or is out of tolerance.</source>
        <translation>La calibrazione richiede cinque minuti. Misura l’obiettivo, l’errore di profondità e l’allineamento fra profondità e colore. Eseguirla una volta per telecamera, e di nuovo se la telecamera ha subito un urto o è fuori tolleranza.</translation>
    </message>
    <message>
        <source>Print at 100 % (“actual size”) on plain paper. Glue the print flat onto something stiff, such as glass or thick cardboard. Then measure the printed ruler.</source>
        <translation>Stampare al 100 % (“dimensioni effettive”) su carta comune. Incollare il foglio ben piano su qualcosa di rigido, come vetro o cartone spesso. Poi misurare il righello stampato.</translation>
    </message>
</context>
<context>
    <name>BubbleView</name>
    <message>
        <source>&amp;Next</source>
        <translation>A&amp;vanti</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>First session · {number} of {count}</source>
        <translation>Prima seduta · {number} di {count}</translation>
    </message>
    <message>
        <source>First session</source>
        <translation>Prima seduta</translation>
    </message>
    <message>
        <source>&amp;Done</source>
        <translation>&amp;Fine</translation>
    </message>
    <message>
        <source>End the tour</source>
        <translation>Termina la visita</translation>
    </message>
</context>
<context>
    <name>CameraCalibrationFlow</name>
    <message>
        <source>Camera calibration</source>
        <translation>Calibrazione della telecamera</translation>
    </message>
    <message>
        <source>Save the board to print</source>
        <translation>Salva la tavola da stampare</translation>
    </message>
    <message>
        <source>Add more images with the board closer and more tilted: {why}.</source>
        <translation>Aggiungere immagini con la tavola più vicina e più inclinata: {why}.</translation>
    </message>
</context>
<context>
    <name>CameraCard</name>
    <message>
        <source>Camera</source>
        <translation>Telecamera</translation>
    </message>
    <message>
        <source>Chec&amp;k card…</source>
        <translation>Cartoncino di con&amp;trollo…</translation>
    </message>
    <message>
        <source>Cali&amp;brate the camera…</source>
        <translation>Cali&amp;bra la telecamera…</translation>
    </message>
    <message>
        <source>In the demo the camera is simulated. It needs no calibration.</source>
        <translation>Nella demo la telecamera è simulata. Non serve calibrarla.</translation>
    </message>
    <message>
        <source>A printed board calibrates the camera. A printed card checks in 30 seconds whether the camera is still within tolerance.</source>
        <translation>Una tavola stampata calibra la telecamera. Un cartoncino stampato controlla in 30 secondi se la telecamera misura ancora entro la tolleranza.</translation>
    </message>
</context>
<context>
    <name>CameraFlow</name>
    <message>
        <source>The camera is being opened.</source>
        <translation>Apertura della telecamera.</translation>
    </message>
    <message>
        <source>The recording is being opened.</source>
        <translation>Apertura della registrazione.</translation>
    </message>
    <message>
        <source>Choose the source again</source>
        <translation>Scegli di nuovo la sorgente</translation>
    </message>
    <message>
        <source>The simulated patient is being prepared.</source>
        <translation>Preparazione del paziente simulato.</translation>
    </message>
</context>
<context>
    <name>CameraNameDialog</name>
    <message>
        <source>Camera name</source>
        <translation>Nome della telecamera</translation>
    </message>
    <message>
        <source>Continue</source>
        <translation>Continua</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Annulla</translation>
    </message>
    <message>
        <source>Is this still the camera “{name}”?</source>
        <translation>È ancora la telecamera “{name}”?</translation>
    </message>
    <message>
        <source>What is this camera called?</source>
        <translation>Come si chiama questa telecamera?</translation>
    </message>
    <message>
        <source>This camera has no readable serial number. If it is a different one, enter its name: calibrations and checks are saved under that name.</source>
        <translation>Questa telecamera non comunica il numero di serie. Se è un’altra, inserire il suo nome: calibrazioni e controlli si salvano con quel nome.</translation>
    </message>
    <message>
        <source>This camera has no readable serial number. Name it and label it: calibrations and checks are saved under that name. Carpus treats every camera of this type without a number as this one.</source>
        <translation>Questa telecamera non comunica il numero di serie. Darle un nome e scriverlo su di essa: calibrazioni e controlli si salvano con quel nome. Carpus considera ogni telecamera di questo tipo senza numero come questa.</translation>
    </message>
</context>
<context>
    <name>CameraScreen</name>
    <message>
        <source>Camera</source>
        <translation>Telecamera</translation>
    </message>
    <message>
        <source>Recording</source>
        <translation>Registrazione</translation>
    </message>
    <message>
        <source>Simulated camera</source>
        <translation>Telecamera simulata</translation>
    </message>
    <message>
        <source>Choose a &amp;file…</source>
        <translation>Scegli un &amp;file…</translation>
    </message>
    <message>
        <source>Choose a fol&amp;der…</source>
        <translation>Scegli una &amp;cartella…</translation>
    </message>
    <message>
        <source>Progress</source>
        <translation>Avanzamento</translation>
    </message>
    <message>
        <source>Which image source?</source>
        <translation>Quale sorgente di immagini?</translation>
    </message>
    <message>
        <source>Before you continue</source>
        <translation>Prima di proseguire</translation>
    </message>
    <message>
        <source>Camera above the hand, 60 cm or more away, looking straight down. No sun on the markers.</source>
        <translation>Telecamera sopra la mano, a 60 cm o più, puntata verticalmente verso il basso. Niente sole sui marcatori.</translation>
    </message>
    <message>
        <source>The depth camera over the hand.</source>
        <translation>La telecamera di profondità sopra la mano.</translation>
    </message>
    <message>
        <source>Camera ready</source>
        <translation>Telecamera pronta</translation>
    </message>
    <message>
        <source>No camera</source>
        <translation>Nessuna telecamera</translation>
    </message>
    <message>
        <source>Open the camera</source>
        <translation>Apri la telecamera</translation>
    </message>
    <message>
        <source>Open the recording</source>
        <translation>Apri la registrazione</translation>
    </message>
    <message>
        <source>Start the simulation</source>
        <translation>Avvia la simulazione</translation>
    </message>
    <message>
        <source>No camera yet</source>
        <translation>Ancora nessuna telecamera</translation>
    </message>
    <message>
        <source>Choose a recording first</source>
        <translation>Prima scegliere una registrazione</translation>
    </message>
    <message>
        <source>Opening…</source>
        <translation>Apertura…</translation>
    </message>
    <message>
        <source>Recordings ({patterns});;All files (*)</source>
        <translation>Registrazioni ({patterns});;Tutti i file (*)</translation>
    </message>
    <message>
        <source>Choose a recording</source>
        <translation>Scegliere una registrazione</translation>
    </message>
    <message>
        <source>A saved recording: a file of Carpus or of the camera (.oni, .db3), or an image folder.</source>
        <translation>Una registrazione salvata: un file di Carpus o della telecamera (.oni, .db3), o una cartella di immagini.</translation>
    </message>
    <message>
        <source>Plug it directly into the computer.</source>
        <translation>Collegarla direttamente al computer.</translation>
    </message>
    <message>
        <source>Choose an image folder</source>
        <translation>Scegliere una cartella di immagini</translation>
    </message>
    <message>
        <source>A simulated hand does the exercise, so that you can try Carpus. The session is marked as simulated.</source>
        <translation>Per provare Carpus, una mano simulata esegue l’esercizio. La seduta è segnata come simulata.</translation>
    </message>
</context>
<context>
    <name>CheckCardFlow</name>
    <message>
        <source>Check card</source>
        <translation>Cartoncino di controllo</translation>
    </message>
    <message>
        <source>Save the card to print</source>
        <translation>Salva il cartoncino da stampare</translation>
    </message>
</context>
<context>
    <name>CheckCardScreen</name>
    <message>
        <source>Print &amp;card…</source>
        <translation>&amp;Stampa…</translation>
    </message>
    <message>
        <source>Cali&amp;brate the camera…</source>
        <translation>Cali&amp;bra la telecamera…</translation>
    </message>
    <message>
        <source>Progress of the check</source>
        <translation>Avanzamento del controllo</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Interrompi</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>Print both pages at 100 %: each ruler must be 100 mm long. Glue the first page flat onto stiff card. Fold the wedge and glue it onto the dashed field.</source>
        <translation>Stampare le due pagine al 100 %: ogni righello deve misurare 100 mm. Incollare la prima pagina ben piana su cartone rigido. Piegare il cuneo e incollarlo sul campo tratteggiato.</translation>
    </message>
    <message>
        <source>Check now, 30 seconds</source>
        <translation>Controlla ora, 30 secondi</translation>
    </message>
    <message>
        <source>Check · connect the camera</source>
        <translation>Controlla · collegare la telecamera</translation>
    </message>
    <message>
        <source>Within tolerance</source>
        <translation>Entro la tolleranza</translation>
    </message>
    <message>
        <source>Check again</source>
        <translation>Controllare di nuovo</translation>
    </message>
    <message>
        <source>Out of tolerance</source>
        <translation>Fuori tolleranza</translation>
    </message>
    <message>
        <source>Opening the camera…</source>
        <translation>Apertura della telecamera…</translation>
    </message>
    <message>
        <source>{seconds} s</source>
        <translation>{seconds} s</translation>
    </message>
    <message>
        <source>Not checked yet</source>
        <translation>Non ancora controllata</translation>
    </message>
    <message>
        <source>A check is valid for one week. If all lengths are wrong by the same percentage, the depth or the print size is wrong.</source>
        <translation>Un controllo vale una settimana. Se tutte le lunghezze si scostano della stessa percentuale, è errata la profondità o la dimensione della stampa.</translation>
    </message>
</context>
<context>
    <name>CheckRow</name>
    <message>
        <source>good</source>
        <translation>buono</translation>
    </message>
    <message>
        <source>to check</source>
        <translation>da verificare</translation>
    </message>
    <message>
        <source>missing</source>
        <translation>manca</translation>
    </message>
</context>
<context>
    <name>ChoiceDialog</name>
    <message>
        <source>Choice</source>
        <translation>Scelta</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Annulla</translation>
    </message>
</context>
<context>
    <name>ComparisonFlow</name>
    <message>
        <source>Simulated data: no patient was measured. Excluded from analysis.</source>
        <translation>Dati simulati: non sono misure di un paziente. Esclusi dall’analisi.</translation>
    </message>
</context>
<context>
    <name>ComparisonScreen</name>
    <message>
        <source>Reading both sessions…</source>
        <translation>Lettura delle due sedute…</translation>
    </message>
    <message>
        <source>Reading the session…</source>
        <translation>Lettura della seduta…</translation>
    </message>
    <message>
        <source>Repetition {number}</source>
        <translation>Rip. {number}</translation>
    </message>
    <message>
        <source>repetition</source>
        <translation>ripetizione</translation>
    </message>
    <message>
        <source>Differences</source>
        <translation>Differenze</translation>
    </message>
    <message>
        <source>The sessions cannot be compared, because one of them could not be read.</source>
        <translation>Le sedute non si possono confrontare, perché una non è leggibile.</translation>
    </message>
</context>
<context>
    <name>CorrectionFrameView</name>
    <message>
        <source>Frame with labels to correct</source>
        <translation>Fotogramma con le etichette da correggere</translation>
    </message>
    <message>
        <source>{marker}, before</source>
        <translation>{marker}, prima</translation>
    </message>
    <message>
        <source>{marker}, occluded</source>
        <translation>{marker}, nascosto</translation>
    </message>
    <message>
        <source>{marker}?</source>
        <translation>{marker}?</translation>
    </message>
</context>
<context>
    <name>CorrectionScreen</name>
    <message>
        <source>Next uncertain frame</source>
        <translation>Fotogramma incerto seguente</translation>
    </message>
    <message>
        <source>Not visible here</source>
        <translation>Qui non visibile</translation>
    </message>
    <message>
        <source>Re-analyse from here</source>
        <translation>Rianalizza da qui</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Annulla</translation>
    </message>
    <message>
        <source>Back to the review (Esc)</source>
        <translation>Torna alla revisione (Esc)</translation>
    </message>
    <message>
        <source>Distance to the expected position</source>
        <translation>Distanza dalla posizione attesa</translation>
    </message>
    <message>
        <source>Reading the frame…</source>
        <translation>Lettura del fotogramma…</translation>
    </message>
    <message>
        <source>Uncertain at {time}</source>
        <translation>Incerto a {time}</translation>
    </message>
    <message>
        <source>Frame at {time}</source>
        <translation>Fotogramma a {time}</translation>
    </message>
    <message>
        <source>Which label is wrong?</source>
        <translation>Quale etichetta è sbagliata?</translation>
    </message>
    <message>
        <source>Drag a label in the frame, or select it below and click its marker.</source>
        <translation>Trascinare un’etichetta nel fotogramma, o selezionarla sotto e fare clic sul suo marcatore.</translation>
    </message>
    <message>
        <source>No video was saved. These are the {count} blue spots of this frame. Drag a label to its spot.</source>
        <translation>Nessun video salvato. Questi sono i {count} punti blu di questo fotogramma. Trascinare un’etichetta sul suo punto.</translation>
    </message>
    <message>
        <source>Re-analyse from {time}</source>
        <translation>Rianalizza da {time}</translation>
    </message>
    <message>
        <source>Nothing corrected yet</source>
        <translation>Ancora nessuna correzione</translation>
    </message>
    <message>
        <source>Changed here: {markers}</source>
        <translation>Cambiamenti qui: {markers}</translation>
    </message>
    <message>
        <source>Drag the label “{marker}” to its marker</source>
        <translation>Trascinare l’etichetta “{marker}” sul suo marcatore</translation>
    </message>
</context>
<context>
    <name>CourseRunner</name>
    <message>
        <source>Exercise set “{name}”, {number} of {count}: {part}</source>
        <translation>Sequenza “{name}”, {number} di {count}: {part}</translation>
    </message>
    <message>
        <source>Rest {time}. Press Space to start now.</source>
        <translation>Pausa {time}. Barra spaziatrice: iniziare subito.</translation>
    </message>
</context>
<context>
    <name>DateField</name>
    <message>
        <source>day month year</source>
        <translation>giorno mese anno</translation>
    </message>
    <message>
        <source>The date is in the future</source>
        <translation>La data è nel futuro</translation>
    </message>
    <message>
        <source>This date does not exist</source>
        <translation>Questa data non esiste</translation>
    </message>
    <message>
        <source>Day, month, year</source>
        <translation>Giorno, mese, anno</translation>
    </message>
</context>
<context>
    <name>DegreesField</name>
    <message>
        <source>Up to {most}°, or empty</source>
        <translation>Fino a {most}°, o vuoto</translation>
    </message>
</context>
<context>
    <name>DeleteDialog</name>
    <message>
        <source>Delete permanently</source>
        <translation>Elimina definitivamente</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Annulla</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>Archive instead</source>
        <translation>Archivia invece</translation>
    </message>
    <message>
        <source>Deleted</source>
        <translation>Viene eliminato</translation>
    </message>
    <message>
        <source>Not deleted</source>
        <translation>Non viene eliminato</translation>
    </message>
    <message>
        <source>Cannot be undone</source>
        <translation>Non si può annullare</translation>
    </message>
    <message>
        <source>Delete this session permanently?</source>
        <translation>Eliminare definitivamente questa seduta?</translation>
    </message>
    <message>
        <source>Delete this patient permanently?</source>
        <translation>Eliminare definitivamente questo paziente?</translation>
    </message>
    <message>
        <source>To delete, type “{name}” here</source>
        <translation>Per eliminare, scrivere qui “{name}”</translation>
    </message>
    <message>
        <source>Angles, images, notes and pain scores of this session ({size} MB, files: {files}).</source>
        <translation>Angoli, immagini, note e punteggi del dolore di questa seduta ({size} MB, file: {files}).</translation>
    </message>
    <message>
        <source>Backups up to {day} and copies elsewhere.</source>
        <translation>Copie di sicurezza fino al giorno {day} e copie altrove.</translation>
    </message>
    <message>
        <source>Copies elsewhere.</source>
        <translation>Copie altrove.</translation>
    </message>
    <message>
        <source>The log records the deletion, without a name.</source>
        <translation>Il registro annota l’eliminazione, senza nome.</translation>
    </message>
    <message>
        <source>The retention period set in Settings ({years} years) ends on {day}. You would delete before that date.</source>
        <translation>Il periodo di conservazione impostato ({years} anni) termina in data {day}. L’eliminazione avverrebbe prima.</translation>
    </message>
    <message>
        <source>The patient’s other sessions.</source>
        <translation>Le altre sedute del paziente.</translation>
    </message>
    <message>
        <source>The patient’s entry: real name, notes, manual measurements. All sessions ({count}): angles, images, notes ({size} MB, files: {files}).</source>
        <translation>La scheda del paziente: nome vero, note, misure manuali. Tutte le sedute ({count}): angoli, immagini, note ({size} MB, file: {files}).</translation>
    </message>
    <message>
        <source>Archiving removes it from all lists and results. Everything can be restored.</source>
        <translation>L’archiviazione toglie tutto da elenchi e risultati. Tutto si può ripristinare.</translation>
    </message>
    <message>
        <source>Delete reports and exports saved elsewhere yourself ({n}): {path}.</source>
        <translation>Da eliminare di persona: relazioni ed esportazioni salvate altrove ({n}): {path}.</translation>
    </message>
    <message>
        <source>Check these files outside the patient’s folder yourself ({n}): {path}.</source>
        <translation>Da controllare di persona: file fuori dalla cartella del paziente ({n}): {path}.</translation>
    </message>
    <message>
        <source>Deleted data cannot be restored.</source>
        <translation>I dati eliminati non si possono ripristinare.</translation>
    </message>
    <message>
        <source>Deleted data cannot be restored, not even from a backup.</source>
        <translation>I dati eliminati non si possono ripristinare, nemmeno da una copia di sicurezza.</translation>
    </message>
</context>
<context>
    <name>DeletionController</name>
    <message>
        <source>The session of {day} is in the archive.</source>
        <translation>La seduta in data {day} è nell’archivio.</translation>
    </message>
    <message>
        <source>{name} is in the archive.</source>
        <translation>{name} è nell’archivio.</translation>
    </message>
    <message>
        <source>&amp;Undo</source>
        <translation>&amp;Annulla</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Chiudi</translation>
    </message>
    <message>
        <source>The session was deleted.</source>
        <translation>La seduta è stata eliminata.</translation>
    </message>
    <message>
        <source>The patient was deleted.</source>
        <translation>Il paziente è stato eliminato.</translation>
    </message>
    <message>
        <source>Files deleted: {count}.</source>
        <translation>File eliminati: {count}.</translation>
    </message>
    <message>
        <source>The session now belongs to {name}.</source>
        <translation>La seduta ora appartiene a {name}.</translation>
    </message>
    <message>
        <source>Nothing was deleted. Archived items are excluded until restored.</source>
        <translation>Nulla è stato eliminato. Ciò che è archiviato resta escluso finché non viene ripristinato.</translation>
    </message>
</context>
<context>
    <name>Dialog</name>
    <message>
        <source>Cancel</source>
        <translation>Annulla</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>Your entries are not saved yet. Press Esc again to close without saving.</source>
        <translation>I dati inseriti non sono ancora salvati. Premere di nuovo Esc per chiudere senza salvare.</translation>
    </message>
</context>
<context>
    <name>ExcludeDialog</name>
    <message>
        <source>Exclude this session?</source>
        <translation>Escludere questa seduta?</translation>
    </message>
    <message>
        <source>wrong exercise</source>
        <translation>esercizio sbagliato</translation>
    </message>
    <message>
        <source>Exclude</source>
        <translation>Escludi</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Annulla</translation>
    </message>
    <message>
        <source>pain</source>
        <translation>dolore</translation>
    </message>
    <message>
        <source>markers lost</source>
        <translation>marcatori persi</translation>
    </message>
    <message>
        <source>Another reason</source>
        <translation>Un altro motivo</translation>
    </message>
    <message>
        <source>The session stays in the list and can be opened, but is excluded from analysis. You can include it again.</source>
        <translation>La seduta resta nell’elenco e si può aprire, ma è esclusa dall’analisi. Si può includere di nuovo.</translation>
    </message>
    <message>
        <source>practice run</source>
        <translation>prova</translation>
    </message>
</context>
<context>
    <name>ExclusionDialog</name>
    <message>
        <source>pain</source>
        <translation>dolore</translation>
    </message>
    <message>
        <source>Passive (moved by the therapist): analysed separately from active repetitions.</source>
        <translation>Passiva (mossa dal terapista): analizzata separatamente dalle ripetizioni attive.</translation>
    </message>
    <message>
        <source>Passive</source>
        <translation>Passiva</translation>
    </message>
    <message>
        <source>other movement</source>
        <translation>altro movimento</translation>
    </message>
    <message>
        <source>Another reason</source>
        <translation>Un altro motivo</translation>
    </message>
    <message>
        <source>Keep included</source>
        <translation>Non escludere</translation>
    </message>
    <message>
        <source>Is repetition {number} passive or excluded?</source>
        <translation>La ripetizione {number} è passiva o esclusa?</translation>
    </message>
    <message>
        <source>Exclude</source>
        <translation>Escludi</translation>
    </message>
    <message>
        <source>Passive from here on</source>
        <translation>Passiva da qui in poi</translation>
    </message>
    <message>
        <source>Excluded from the results, but still shown on the curves and mentioned in the report.</source>
        <translation>Esclusa dai risultati, ma ancora visibile nelle curve e citata nella relazione.</translation>
    </message>
    <message>
        <source>practice run</source>
        <translation>prova</translation>
    </message>
</context>
<context>
    <name>ExerciseScreen</name>
    <message>
        <source>none</source>
        <translation>nessuna</translation>
    </message>
    <message>
        <source>no goal</source>
        <translation>nessuno</translation>
    </message>
    <message>
        <source>Use as goals</source>
        <translation>Usa come obiettivi</translation>
    </message>
    <message>
        <source>Inferred</source>
        <translation>Dedotte</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>Misurate</translation>
    </message>
    <message>
        <source>DIP joints of the fingers</source>
        <translation>Articolazioni IFD delle dita</translation>
    </message>
    <message>
        <source>Adult</source>
        <translation>Adulti</translation>
    </message>
    <message>
        <source>Child</source>
        <translation>Bambini</translation>
    </message>
    <message>
        <source>No</source>
        <translation>No</translation>
    </message>
    <message>
        <source>Yes</source>
        <translation>Sì</translation>
    </message>
    <message>
        <source>Which exercise?</source>
        <translation>Quale esercizio?</translation>
    </message>
    <message>
        <source>Hand to measure</source>
        <translation>Mano da misurare</translation>
    </message>
    <message>
        <source>Repetitions</source>
        <translation>Ripetizioni</translation>
    </message>
    <message>
        <source>The patient’s view is for</source>
        <translation>La vista del paziente è per</translation>
    </message>
    <message>
        <source>Also save video</source>
        <translation>Salvare anche il video</translation>
    </message>
    <message>
        <source>Goal, {movement}</source>
        <translation>Obiettivo, {movement}</translation>
    </message>
    <message>
        <source>Which hand is measured?</source>
        <translation>Quale mano si misura?</translation>
    </message>
    <message>
        <source>Exercise sets…</source>
        <translation>Sequenze di esercizi…</translation>
    </message>
    <message>
        <source>This recording</source>
        <translation>Questa registrazione</translation>
    </message>
    <message>
        <source>Needed to see and correct markers later. Uses {size} MB per minute; space for {time}.</source>
        <translation>Serve per vedere e correggere i marcatori in seguito. Occupa {size} MB al minuto; spazio per {time}.</translation>
    </message>
    <message>
        <source>Next</source>
        <translation>Avanti</translation>
    </message>
</context>
<context>
    <name>ExportController</name>
    <message>
        <source>Export to folder</source>
        <translation>Esporta in una cartella</translation>
    </message>
</context>
<context>
    <name>ExportDialog</name>
    <message>
        <source>Tables (CSV): angles, joints, markers, events, values</source>
        <translation>Tabelle (CSV): angoli, articolazioni, marcatori, eventi, valori</translation>
    </message>
    <message>
        <source>Values with their origin (JSON)</source>
        <translation>Valori con la loro origine (JSON)</translation>
    </message>
    <message>
        <source>Markers for motion capture programs (C3D)</source>
        <translation>Marcatori per programmi di analisi del movimento (C3D)</translation>
    </message>
    <message>
        <source>Markers for OpenSim (TRC)</source>
        <translation>Marcatori per OpenSim (TRC)</translation>
    </message>
    <message>
        <source>Angles for OpenSim (MOT)</source>
        <translation>Angoli per OpenSim (MOT)</translation>
    </message>
    <message>
        <source>Data set for research (BIDS-Motion)</source>
        <translation>Dati per la ricerca (BIDS-Motion)</translation>
    </message>
    <message>
        <source>Session file, for another Carpus installation</source>
        <translation>File della seduta, per un’altra installazione di Carpus</translation>
    </message>
    <message>
        <source>Existing files are never overwritten.</source>
        <translation>I file già presenti non vengono mai sovrascritti.</translation>
    </message>
    <message>
        <source>Tables of angles, repetitions and values (CSV), for any spreadsheet.</source>
        <translation>Tabelle di angoli, ripetizioni e valori (CSV), per qualsiasi foglio di calcolo.</translation>
    </message>
    <message>
        <source>Export this session</source>
        <translation>Esportare questa seduta</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Annulla</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Interrompi</translation>
    </message>
    <message>
        <source>&amp;Tables for</source>
        <translation>&amp;Tabelle per</translation>
    </message>
    <message>
        <source>De-identified: random name, relative days, no notes</source>
        <translation>De-identificata: nome casuale, giorni contati invece di date, senza note</translation>
    </message>
    <message>
        <source>Progress of the export</source>
        <translation>Avanzamento dell’esportazione</translation>
    </message>
    <message>
        <source>Choose folder…</source>
        <translation>Scegli la cartella…</translation>
    </message>
    <message>
        <source>&amp;Other formats…</source>
        <translation>&amp;Altri formati…</translation>
    </message>
    <message>
        <source>For JSON, C3D, TRC, MOT and BIDS, turn on “For research” in the settings.</source>
        <translation>Per JSON, C3D, TRC, MOT e BIDS attivare “Per la ricerca” nelle impostazioni.</translation>
    </message>
    <message>
        <source>other programs: 1.5, separated by commas</source>
        <translation>altri programmi: 1.5, separati da virgole</translation>
    </message>
    <message>
        <source>a spreadsheet in {region}: {example}</source>
        <translation>un foglio di calcolo in {region}: {example}</translation>
    </message>
    <message>
        <source>Values for a hospital system (FHIR R4)</source>
        <translation>Valori per un sistema ospedaliero (FHIR R4)</translation>
    </message>
</context>
<context>
    <name>FaultDetails</name>
    <message>
        <source>Details</source>
        <translation>Dettagli</translation>
    </message>
    <message>
        <source>Copy</source>
        <translation>Copia</translation>
    </message>
</context>
<context>
    <name>FingerCurves</name>
    <message>
        <source>Joint angles of the last ten seconds, by finger</source>
        <translation>Angoli articolari degli ultimi dieci secondi, per dito</translation>
    </message>
    <message>
        <source>Last 10 s</source>
        <translation>Ultimi 10 s</translation>
    </message>
    <message>
        <source>Flexion</source>
        <translation>Flessione</translation>
    </message>
    <message>
        <source>Abduction</source>
        <translation>Abduzione</translation>
    </message>
    <message>
        <source>inferred from PIP</source>
        <translation>dedotta dalla IFP</translation>
    </message>
    <message>
        <source>inferred</source>
        <translation>dedotta</translation>
    </message>
</context>
<context>
    <name>FingerGrid</name>
    <message>
        <source>Finger joints, goniometer</source>
        <translation>Articolazioni delle dita, goniometro</translation>
    </message>
    <message>
        <source>Measured by Carpus on this day</source>
        <translation>Misurato da Carpus in questo giorno</translation>
    </message>
</context>
<context>
    <name>FrameView</name>
    <message>
        <source>Camera image</source>
        <translation>Immagine della telecamera</translation>
    </message>
</context>
<context>
    <name>GuidancePanel</name>
    <message>
        <source>Lay the hand flat and still</source>
        <translation>Mettere la mano piatta e ferma</translation>
    </message>
    <message>
        <source>Checks</source>
        <translation>Controlli</translation>
    </message>
    <message>
        <source>Marker {number} of {asked}</source>
        <translation>Marcatore {number} di {asked}</translation>
    </message>
    <message>
        <source>All markers found</source>
        <translation>Trovati tutti i marcatori</translation>
    </message>
    <message>
        <source>Checking the markers…</source>
        <translation>Controllo dei marcatori…</translation>
    </message>
    <message>
        <source>Start measuring · {left}</source>
        <translation>Inizia a misurare · {left}</translation>
    </message>
    <message>
        <source>No blue marker in the image</source>
        <translation>Nessun marcatore blu nell’immagine</translation>
    </message>
    <message>
        <source>No blue marker is visible</source>
        <translation>Nessun marcatore blu visibile</translation>
    </message>
    <message>
        <source>No markers found. Check that they are on the hand, the hand is in view and the light is good.</source>
        <translation>Nessun marcatore trovato. Controllare che siano sulla mano, che la mano sia inquadrata e che la luce sia buona.</translation>
    </message>
    <message>
        <source>Looking for the markers…</source>
        <translation>Ricerca dei marcatori…</translation>
    </message>
    <message>
        <source>Ready to measure</source>
        <translation>Pronto a misurare</translation>
    </message>
    <message>
        <source>Start measuring</source>
        <translation>Inizia a misurare</translation>
    </message>
    <message>
        <source>Swap the two</source>
        <translation>Scambia i due</translation>
    </message>
    <message>
        <source>Click the marker again</source>
        <translation>Rifai il clic sul marcatore</translation>
    </message>
    <message>
        <source>Correct labels</source>
        <translation>Correggi le etichette</translation>
    </message>
    <message>
        <source>Use that spot</source>
        <translation>Usa quel punto</translation>
    </message>
    <message>
        <source>New image</source>
        <translation>Nuova immagine</translation>
    </message>
    <message>
        <source>Start anyway (&amp;uncertain)</source>
        <translation>Inizia &amp;comunque</translation>
    </message>
    <message>
        <source>Image</source>
        <translation>Immagine</translation>
    </message>
    <message>
        <source>Palm down, fingers as straight as possible, forearm in line. Then take the image.</source>
        <translation>Palmo in giù, dita il più estese possibile, avambraccio in asse con la mano. Poi acquisire l’immagine.</translation>
    </message>
    <message>
        <source>Take the image</source>
        <translation>Acquisisci l’immagine</translation>
    </message>
    <message>
        <source>Hold the hand in this position until measuring begins.</source>
        <translation>Tenere la mano in questa posizione finché non inizia la misurazione.</translation>
    </message>
    <message>
        <source>Click the markers</source>
        <translation>Clic sui marcatori</translation>
    </message>
    <message>
        <source>1 marker left to click</source>
        <translation>manca 1 marcatore</translation>
    </message>
    <message>
        <source>{count} markers left to click</source>
        <translation>mancano {count} marcatori</translation>
    </message>
</context>
<context>
    <name>HandDrawing</name>
    <message>
        <source>Hand from above</source>
        <translation>Mano dall’alto</translation>
    </message>
    <message>
        <source>Right hand,
from above</source>
        <translation>Mano destra,
dall’alto</translation>
    </message>
    <message>
        <source>Left hand,
from above</source>
        <translation>Mano sinistra,
dall’alto</translation>
    </message>
</context>
<context>
    <name>HandImageDialog</name>
    <message>
        <source>Image of the hand</source>
        <translation>Immagine della mano</translation>
    </message>
    <message>
        <source>Carpus cannot protect the saved file: anyone who has it can open it. The export is logged.</source>
        <translation>Carpus non può proteggere il file salvato: chi lo possiede può aprirlo. L’esportazione viene annotata nel registro.</translation>
    </message>
    <message>
        <source>The hand is not visible here, or its marker labels are uncertain. Choose another moment.</source>
        <translation>La mano qui non è visibile, o le etichette dei marcatori sono incerte. Scegliere un altro momento.</translation>
    </message>
    <message>
        <source>The patient has agreed</source>
        <translation>Il paziente ha acconsentito</translation>
    </message>
    <message>
        <source>Save…</source>
        <translation>Salva…</translation>
    </message>
    <message>
        <source>The image shows only the hand and its angle. Face, room and name are removed. If the hand does not move in the image plane, the angle is only written, not drawn.</source>
        <translation>L’immagine mostra solo la mano e il suo angolo. Viso, stanza e nome sono rimossi. Se la mano non si muove nel piano dell’immagine, l’angolo è solo scritto, non disegnato.</translation>
    </message>
</context>
<context>
    <name>HelpScreen</name>
    <message>
        <source>Back</source>
        <translation>Indietro</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>Keys</source>
        <translation>Tasti</translation>
    </message>
    <message>
        <source>Guide</source>
        <translation>Guida</translation>
    </message>
    <message>
        <source>Save the cards</source>
        <translation>Salva le schede</translation>
    </message>
    <message>
        <source>Print cards…</source>
        <translation>Stampa le schede…</translation>
    </message>
    <message>
        <source>&amp;Guide me through a first session</source>
        <translation>&amp;Guidami in una prima seduta</translation>
    </message>
</context>
<context>
    <name>HomeDialog</name>
    <message>
        <source>Home exercise sheet</source>
        <translation>Scheda di esercizi a casa</translation>
    </message>
    <message>
        <source>One page for the patient, without values or diagnosis. Up to {count} exercises.</source>
        <translation>Una pagina per il paziente, senza valori né diagnosi. Fino a {count} esercizi.</translation>
    </message>
    <message>
        <source>Ne&amp;xt appointment</source>
        <translation>Prossimo &amp;appuntamento</translation>
    </message>
    <message>
        <source>T&amp;ime</source>
        <translation>&amp;Ora</translation>
    </message>
    <message>
        <source>Language of the patient</source>
        <translation>Lingua del paziente</translation>
    </message>
    <message>
        <source>Show the sheet</source>
        <translation>Mostra il foglio</translation>
    </message>
    <message>
        <source>Time: {count} characters too long</source>
        <translation>Ora: {count} caratteri di troppo</translation>
    </message>
    <message>
        <source>&amp;Repetitions</source>
        <translation>&amp;Ripetizioni</translation>
    </message>
    <message>
        <source>Times a &amp;day</source>
        <translation>Volte al &amp;giorno</translation>
    </message>
    <message>
        <source>&amp;Message to the patient (no names)</source>
        <translation>&amp;Messaggio al paziente (senza nomi)</translation>
    </message>
    <message>
        <source>Message: {count} characters too long</source>
        <translation>Messaggio: {count} caratteri di troppo</translation>
    </message>
</context>
<context>
    <name>LetterDialog</name>
    <message>
        <source>Letter to the doctor</source>
        <translation>Lettera al medico</translation>
    </message>
    <message>
        <source>One page with the values of this session and your comment. Addresses stay in your list.</source>
        <translation>Una pagina con i valori di questa seduta e il commento. Gli indirizzi restano nell’elenco.</translation>
    </message>
    <message>
        <source>Name and address, up to {count} lines</source>
        <translation>Nome e indirizzo, fino a {count} righe</translation>
    </message>
    <message>
        <source>Language of the letter</source>
        <translation>Lingua della lettera</translation>
    </message>
    <message>
        <source>Print the patient’s real name</source>
        <translation>Stampa il nome vero del paziente</translation>
    </message>
    <message>
        <source>Show the letter</source>
        <translation>Mostra la lettera</translation>
    </message>
    <message>
        <source>Previous recipients</source>
        <translation>Destinatari precedenti</translation>
    </message>
    <message>
        <source>The name appears in this letter only. Anyone who has the file can read it.</source>
        <translation>Il nome compare solo in questa lettera. Chi ha il file può leggerlo.</translation>
    </message>
</context>
<context>
    <name>LicencesWindow</name>
    <message>
        <source>Components and licences</source>
        <translation>Componenti e licenze</translation>
    </message>
    <message>
        <source>The licences are legal texts and are shown in their original language.</source>
        <translation>Le licenze sono testi legali e restano nella lingua originale.</translation>
    </message>
</context>
<context>
    <name>LiveCurves</name>
    <message>
        <source>Curves of the last ten seconds</source>
        <translation>Curve degli ultimi dieci secondi</translation>
    </message>
    <message>
        <source>no value</source>
        <translation>nessun valore</translation>
    </message>
    <message>
        <source>10 s ago</source>
        <translation>10 s fa</translation>
    </message>
    <message>
        <source>now</source>
        <translation>ora</translation>
    </message>
    <message>
        <source>Speed</source>
        <translation>Velocità</translation>
    </message>
    <message>
        <source>Rotation</source>
        <translation>Rotazione</translation>
    </message>
</context>
<context>
    <name>LiveFlow</name>
    <message>
        <source>Recording paused automatically at {time}.</source>
        <translation>La registrazione è andata in pausa automaticamente a {time}.</translation>
    </message>
    <message>
        <source>Stop and review</source>
        <translation>Termina e rivedi</translation>
    </message>
    <message>
        <source>Choose another source</source>
        <translation>Scegli un’altra sorgente</translation>
    </message>
    <message>
        <source>To the patients</source>
        <translation>Ai pazienti</translation>
    </message>
    <message>
        <source>Continue measuring</source>
        <translation>Continua a misurare</translation>
    </message>
    <message>
        <source>The recording has only just begun.</source>
        <translation>La registrazione è appena iniziata.</translation>
    </message>
    <message>
        <source>Continue measuring or stop now?</source>
        <translation>Continuare a misurare o terminare ora?</translation>
    </message>
    <message>
        <source>Stop recording?</source>
        <translation>Terminare la registrazione?</translation>
    </message>
    <message>
        <source>Continue measuring, or stop: the session is saved and opens in the review.</source>
        <translation>Continuare a misurare o terminare: la seduta viene salvata e si apre nella revisione.</translation>
    </message>
    <message>
        <source>Stop, save and close</source>
        <translation>Termina, salva e chiudi</translation>
    </message>
    <message>
        <source>A recording is running.</source>
        <translation>È in corso una registrazione.</translation>
    </message>
    <message>
        <source>Everything measured so far is saved, whatever you choose.</source>
        <translation>Tutto ciò che è stato misurato finora viene salvato, qualunque sia la scelta.</translation>
    </message>
    <message>
        <source>Continue measuring, or stop: the session is saved and Carpus closes.</source>
        <translation>Continuare a misurare o terminare: la seduta viene salvata e Carpus si chiude.</translation>
    </message>
    <message>
        <source>{time} and {count} full repetitions are saved.</source>
        <translation>Sono salvati {time} e {count} ripetizioni complete.</translation>
    </message>
    <message>
        <source>Recording continues while you choose. Everything is saved.</source>
        <translation>La registrazione prosegue durante la scelta. Tutto viene salvato.</translation>
    </message>
</context>
<context>
    <name>LiveScreen</name>
    <message>
        <source>Patient’s view</source>
        <translation>Vista del paziente</translation>
    </message>
    <message>
        <source>The recording plays from its first frame</source>
        <translation>La registrazione riparte dal primo fotogramma</translation>
    </message>
    <message>
        <source>Waiting for the camera image</source>
        <translation>In attesa dell’immagine</translation>
    </message>
    <message>
        <source>No image</source>
        <translation>Nessuna immagine</translation>
    </message>
    <message>
        <source>Plug the camera in again</source>
        <translation>Ricollegare la telecamera</translation>
    </message>
    <message>
        <source>Recording can start in a moment</source>
        <translation>La registrazione può iniziare tra un attimo</translation>
    </message>
    <message>
        <source>Starts in {seconds}</source>
        <translation>Inizio tra {seconds}</translation>
    </message>
    <message>
        <source>Starts automatically when the hand is still</source>
        <translation>Inizia automaticamente quando la mano sta ferma</translation>
    </message>
    <message>
        <source>Close the patient’s view</source>
        <translation>Chiudi la vista del paziente</translation>
    </message>
    <message>
        <source>Open the patient’s view</source>
        <translation>Apri la vista del paziente</translation>
    </message>
    <message>
        <source>Angles</source>
        <translation>Angoli</translation>
    </message>
    <message>
        <source>Speeds</source>
        <translation>Velocità</translation>
    </message>
    <message>
        <source>Preparing the simulated hand</source>
        <translation>Preparazione della mano simulata</translation>
    </message>
    <message>
        <source>Progress of the analysis</source>
        <translation>Avanzamento dell’analisi</translation>
    </message>
</context>
<context>
    <name>LockCard</name>
    <message>
        <source>Lock</source>
        <translation>Blocco</translation>
    </message>
    <message>
        <source>A PIN only hides the screen. It does not encrypt files.</source>
        <translation>Un PIN nasconde solo lo schermo. Non cifra i file.</translation>
    </message>
    <message>
        <source>After 5 min</source>
        <translation>Dopo 5 min</translation>
    </message>
    <message>
        <source>After 10 min</source>
        <translation>Dopo 10 min</translation>
    </message>
    <message>
        <source>Never</source>
        <translation>Mai</translation>
    </message>
    <message>
        <source>Lock automatically</source>
        <translation>Blocco automatico</translation>
    </message>
    <message>
        <source>PIN</source>
        <translation>PIN</translation>
    </message>
    <message>
        <source>Change PIN…</source>
        <translation>Cambia il PIN…</translation>
    </message>
    <message>
        <source>Set a PIN…</source>
        <translation>Imposta un PIN…</translation>
    </message>
    <message>
        <source>After 30 min</source>
        <translation>Dopo 30 min</translation>
    </message>
    <message>
        <source>lock now</source>
        <translation>blocca ora</translation>
    </message>
</context>
<context>
    <name>LockController</name>
    <message>
        <source>The current PIN is wrong.</source>
        <translation>Il PIN attuale è sbagliato.</translation>
    </message>
    <message>
        <source>Too many attempts. Try again in {seconds} s.</source>
        <translation>Troppi tentativi. Riprovare fra {seconds} s.</translation>
    </message>
</context>
<context>
    <name>LockScreen</name>
    <message>
        <source>Locked</source>
        <translation>Bloccato</translation>
    </message>
    <message>
        <source>PIN</source>
        <translation>PIN</translation>
    </message>
    <message>
        <source>Unlock</source>
        <translation>Sblocca</translation>
    </message>
    <message>
        <source>All data are saved, including the open session.</source>
        <translation>Tutti i dati sono salvati, anche la seduta aperta.</translation>
    </message>
    <message>
        <source>All data are saved.</source>
        <translation>Tutti i dati sono salvati.</translation>
    </message>
    <message>
        <source>Names, images and values are hidden.</source>
        <translation>Nomi, immagini e valori sono nascosti.</translation>
    </message>
    <message>
        <source>Locked automatically at {time} after {minutes} minutes without input.</source>
        <translation>Blocco automatico alle {time} dopo {minutes} min di inattività.</translation>
    </message>
    <message>
        <source>Wrong PIN. 1 attempt left before a 1-minute wait.</source>
        <translation>PIN sbagliato. Ancora 1 tentativo, poi 1 minuto di attesa.</translation>
    </message>
    <message>
        <source>Wrong PIN. {left} attempts left before a 1-minute wait.</source>
        <translation>PIN sbagliato. Ancora {left} tentativi, poi 1 minuto di attesa.</translation>
    </message>
    <message>
        <source>Too many attempts. Try again in {seconds} s.</source>
        <translation>Troppi tentativi. Riprovare fra {seconds} s.</translation>
    </message>
    <message>
        <source>Forgot the PIN? Press F1.</source>
        <translation>PIN dimenticato? Premere F1.</translation>
    </message>
    <message>
        <source>Ask your IT support to remove the PIN. No data are lost.</source>
        <translation>Chiedere al supporto informatico di rimuovere il PIN. Nessun dato va perso.</translation>
    </message>
    <message>
        <source>Locked at {time}.</source>
        <translation>Bloccato alle {time}.</translation>
    </message>
    <message>
        <source>Who is the therapist?</source>
        <translation>Chi è il terapista?</translation>
    </message>
</context>
<context>
    <name>LogDialog</name>
    <message>
        <source>Log</source>
        <translation>Registro</translation>
    </message>
    <message>
        <source>When</source>
        <translation>Quando</translation>
    </message>
    <message>
        <source>Who</source>
        <translation>Chi</translation>
    </message>
    <message>
        <source>What</source>
        <translation>Che cosa</translation>
    </message>
    <message>
        <source>Log: {n} entries</source>
        <translation>Registro: {n} voci</translation>
    </message>
    <message>
        <source>Details</source>
        <translation>Dettagli</translation>
    </message>
    <message>
        <source>Patient</source>
        <translation>Paziente</translation>
    </message>
    <message>
        <source>Done</source>
        <translation>Fine</translation>
    </message>
    <message>
        <source>Entries are added and never changed. The log protects against mistakes, not against someone with full access to this computer. It stores no names: those shown here come from the patient list.</source>
        <translation>Nel registro si possono solo aggiungere voci. Protegge dagli errori, non da chi ha pieno accesso a questo computer. Non contiene nomi. Quelli mostrati vengono dall’elenco dei pazienti.</translation>
    </message>
</context>
<context>
    <name>ManualForm</name>
    <message>
        <source>Active</source>
        <translation>Attivo</translation>
    </message>
    <message>
        <source>Passive</source>
        <translation>Passivo</translation>
    </message>
    <message>
        <source>Carpus</source>
        <translation>Carpus</translation>
    </message>
    <message>
        <source>previous</source>
        <translation>precedente</translation>
    </message>
    <message>
        <source>Extension: − is a deficit, + is hyperextension. Values in italics were measured by Carpus on this day ({sign} = minimum) and are not saved here. Type over them to enter goniometer values.</source>
        <translation>Estensione: − è un deficit, + un’iperestensione. I valori in corsivo sono stati misurati da Carpus in questo giorno ({sign} = minimo) e non vengono salvati qui. Sovrascriverli per inserire i valori del goniometro.</translation>
    </message>
</context>
<context>
    <name>ManualMeasurementsFlow</name>
    <message>
        <source>Leave without saving?</source>
        <translation>Uscire senza salvare?</translation>
    </message>
    <message>
        <source>Some values have not been saved.</source>
        <translation>Alcuni valori non sono ancora salvati.</translation>
    </message>
    <message>
        <source>Save or discard the values.</source>
        <translation>Salvare o scartare i valori.</translation>
    </message>
    <message>
        <source>Discard</source>
        <translation>Scarta</translation>
    </message>
    <message>
        <source>Check the unusual values, or save them as entered</source>
        <translation>Controllare i valori insoliti, o salvarli così</translation>
    </message>
    <message>
        <source>Check the values before you save them.</source>
        <translation>Controllare i valori prima di salvarli.</translation>
    </message>
    <message>
        <source>Save as entered</source>
        <translation>Salva così</translation>
    </message>
    <message>
        <source>Back to the form</source>
        <translation>Torna al modulo</translation>
    </message>
</context>
<context>
    <name>ManualMeasurementsScreen</name>
    <message>
        <source>Date of measurement</source>
        <translation>Data della misurazione</translation>
    </message>
    <message>
        <source>Other measures</source>
        <translation>Altre misure</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Chiudi</translation>
    </message>
    <message>
        <source>Save values</source>
        <translation>Salva i valori</translation>
    </message>
    <message>
        <source>Saved.</source>
        <translation>Salvato.</translation>
    </message>
    <message>
        <source>Leave empty what was not measured. These entries do not change values measured by Carpus.</source>
        <translation>Lasciare vuoto ciò che non è stato misurato. Questi valori non modificano quelli misurati da Carpus.</translation>
    </message>
    <message>
        <source>The Carpus session of this day is simulated and not shown.</source>
        <translation>La seduta Carpus di questo giorno è simulata e non viene mostrata.</translation>
    </message>
    <message>
        <source>Values are saved with initials and time. Later changes stay visible.</source>
        <translation>I valori si salvano con iniziali e ora. Le modifiche successive restano visibili.</translation>
    </message>
    <message>
        <source>Other measures…</source>
        <translation>Altre misure…</translation>
    </message>
    <message>
        <source>Manual measurements, {day}</source>
        <translation>Misure manuali, {day}</translation>
    </message>
    <message>
        <source>Manual and Carpus values are kept separate</source>
        <translation>I valori manuali e quelli di Carpus restano separati</translation>
    </message>
    <message>
        <source>Some values of this or another hand or day are not saved yet.</source>
        <translation>Alcuni valori di questa mano o dell’altra, o di un altro giorno, non sono ancora salvati.</translation>
    </message>
    <message>
        <source>Entered by {initials}.</source>
        <translation>Inseriti da {initials}.</translation>
    </message>
    <message>
        <source>Reference grip strength for this age and sex: {mean} ± {sd} kg ({source}, Smedley dynamometer).</source>
        <translation>Forza di presa di riferimento per età e sesso: {mean} ± {sd} kg ({source}, dinamometro Smedley).</translation>
    </message>
    <message>
        <source>The two kinds of values are neither averaged nor subtracted. Change is assessed within one method only.</source>
        <translation>Dei due tipi di valori non si calcola né la media né la differenza. Il cambiamento si valuta solo all’interno dello stesso metodo.</translation>
    </message>
    <message>
        <source>At least {score}: proposed from the recording of {day}</source>
        <translation>Almeno {score}: proposta dalla registrazione in data {day}</translation>
    </message>
</context>
<context>
    <name>ManualValueChart</name>
    <message>
        <source>Carpus, mean</source>
        <translation>Carpus, media</translation>
    </message>
    <message>
        <source>passive {value}</source>
        <translation>passivo {value}</translation>
    </message>
    <message>
        <source>Carpus {value}</source>
        <translation>Carpus {value}</translation>
    </message>
    <message>
        <source>active {value}</source>
        <translation>attivo {value}</translation>
    </message>
    <message>
        <source>No manual measurements yet.</source>
        <translation>Ancora nessuna misura manuale.</translation>
    </message>
    <message>
        <source>manual, active</source>
        <translation>manuale, attivo</translation>
    </message>
    <message>
        <source>manual</source>
        <translation>manuale</translation>
    </message>
    <message>
        <source>manual, passive</source>
        <translation>manuale, passivo</translation>
    </message>
    <message>
        <source>{name} over time</source>
        <translation>{name} nel corso dei giorni</translation>
    </message>
</context>
<context>
    <name>MarkerFrameView</name>
    <message>
        <source>{marker}?</source>
        <translation>{marker}?</translation>
    </message>
    <message>
        <source>What is this?</source>
        <translation>Che cos’è?</translation>
    </message>
    <message>
        <source>Marker found · {width} px wide</source>
        <translation>Marcatore trovato · largo {width} px</translation>
    </message>
    <message>
        <source>Found · {width} px</source>
        <translation>Trovato · {width} px</translation>
    </message>
    <message>
        <source>Image to click the markers on</source>
        <translation>Immagine su cui fare clic sui marcatori</translation>
    </message>
</context>
<context>
    <name>MarkerRow</name>
    <message>
        <source>{size} mm</source>
        <translation>{size} mm</translation>
    </message>
    <message>
        <source>occluded</source>
        <translation>nascosto</translation>
    </message>
    <message>
        <source>{now}, was {size} mm</source>
        <translation>{now}, prima {size} mm</translation>
    </message>
</context>
<context>
    <name>MarkersFlow</name>
    <message>
        <source>Stay here, or go back to the camera.</source>
        <translation>Restare qui, o tornare alla telecamera.</translation>
    </message>
    <message>
        <source>Back to the camera</source>
        <translation>Torna alla telecamera</translation>
    </message>
    <message>
        <source>Stay here</source>
        <translation>Resta qui</translation>
    </message>
    <message>
        <source>Depth and colour of {name} are misaligned by {px} pixels.</source>
        <translation>Profondità e colore di {name} sono sfasati di {px} pixel.</translation>
    </message>
    <message>
        <source>Open it again with depth aligned to colour, then click the markers again.</source>
        <translation>Riaprirla con la profondità allineata al colore, poi fare di nuovo clic sui marcatori.</translation>
    </message>
    <message>
        <source>Leave this screen?</source>
        <translation>Uscire da questa schermata?</translation>
    </message>
    <message>
        <source>The recording was not changed. It does not say whether depth and colour are aligned.</source>
        <translation>La registrazione non è stata modificata. Non indica se profondità e colore sono allineati.</translation>
    </message>
    <message>
        <source>The labels on this image would be lost.</source>
        <translation>Le etichette su questa immagine andrebbero perse.</translation>
    </message>
    <message>
        <source>Do not change it</source>
        <translation>Non modificare</translation>
    </message>
    <message>
        <source>Open the recording again</source>
        <translation>Riapri la registrazione</translation>
    </message>
</context>
<context>
    <name>MarkersScreen</name>
    <message>
        <source>Wrist cannot reach neutral…</source>
        <translation>Il polso non arriva in neutro…</translation>
    </message>
    <message>
        <source>Start anyway (&amp;uncertain)</source>
        <translation>Inizia &amp;comunque</translation>
    </message>
    <message>
        <source>Click all again</source>
        <translation>Rifai tutti i clic</translation>
    </message>
    <message>
        <source>Waiting for the camera image</source>
        <translation>In attesa dell’immagine</translation>
    </message>
    <message>
        <source>No blue marker here. Click nearer.</source>
        <translation>Qui nessun marcatore blu. Fare clic più vicino.</translation>
    </message>
    <message>
        <source>Already the {name}</source>
        <translation>È già: {name}</translation>
    </message>
    <message>
        <source>This marker is already the {name}. Click another one.</source>
        <translation>Questo marcatore è già: {name}. Fare clic su un altro.</translation>
    </message>
    <message>
        <source>Start position {angles} (entered)</source>
        <translation>Posizione iniziale {angles} (inserita)</translation>
    </message>
    <message>
        <source>Drag a label to its marker. Two labels can be swapped.</source>
        <translation>Trascinare un’etichetta sul suo marcatore. Due etichette si possono scambiare.</translation>
    </message>
    <message>
        <source>The hand lies flat and still, palm down. Fingers that stay bent are fine.</source>
        <translation>La mano è piatta e ferma, palmo in giù. Le dita che restano piegate vanno bene.</translation>
    </message>
    <message>
        <source>Click these again</source>
        <translation>Rifai questi clic</translation>
    </message>
    <message>
        <source>The labels stay as they are until you change one.</source>
        <translation>Le etichette restano finché non se ne cambia una.</translation>
    </message>
    <message>
        <source>All labels are correct</source>
        <translation>Tutte corrette</translation>
    </message>
    <message>
        <source>New image</source>
        <translation>Nuova immagine</translation>
    </message>
</context>
<context>
    <name>MeasureRow</name>
    <message>
        <source>location</source>
        <translation>sede</translation>
    </message>
    <message>
        <source>{name}: location of the measurement</source>
        <translation>{name}: sede della misurazione</translation>
    </message>
    <message>
        <source>unanswered questions {numbers}</source>
        <translation>domande senza risposta {numbers}</translation>
    </message>
    <message>
        <source>{side} {value}</source>
        <translation>{side} {value}</translation>
    </message>
    <message>
        <source>changed</source>
        <translation>modificato</translation>
    </message>
    <message>
        <source>mean {value}</source>
        <translation>media {value}</translation>
    </message>
    <message>
        <source>or {count} answers, {least}–{most}</source>
        <translation>o {count} risposte, {least}–{most}</translation>
    </message>
    <message>
        <source>{name}: answers by number</source>
        <translation>{name}: risposte in numeri</translation>
    </message>
    <message>
        <source>{count} of {all}</source>
        <translation>{count} di {all}</translation>
    </message>
    <message>
        <source>Enter the answers of the paper form in order, with - for no answer. Only the score is saved.</source>
        <translation>Inserire in ordine le risposte del modulo cartaceo, “-” per nessuna risposta. Viene salvato solo il punteggio.</translation>
    </message>
    <message>
        <source>not a valid answer</source>
        <translation>risposta non valida</translation>
    </message>
</context>
<context>
    <name>Messages</name>
    <message>
        <source>Continue</source>
        <translation>Continua</translation>
    </message>
    <message>
        <source>A session of {name} was interrupted on {day} at {time}. It has been recovered.</source>
        <translation>Una seduta di {name} si è interrotta il {day} alle {time}. È stata recuperata.</translation>
    </message>
    <message>
        <source>All data up to {kept} are safe. At most the last second is missing, or more where results were delayed.</source>
        <translation>Tutti i dati fino a {kept} sono al sicuro. Manca al massimo l’ultimo secondo, di più solo se i risultati erano in ritardo.</translation>
    </message>
    <message>
        <source>Review it now or later. It stays in the patient’s session list.</source>
        <translation>Rivederla ora o più tardi. Resta nell’elenco delle sedute del paziente.</translation>
    </message>
    <message>
        <source>Waiting for the camera … {seconds} s</source>
        <translation>In attesa della telecamera … {seconds} s</translation>
    </message>
</context>
<context>
    <name>NavigationButton</name>
    <message>
        <source>{name}, you are here</source>
        <translation>{name}, passo attuale</translation>
    </message>
    <message>
        <source>{name}, done</source>
        <translation>{name}, fatto</translation>
    </message>
</context>
<context>
    <name>NoteDialog</name>
    <message>
        <source>Note</source>
        <translation>Nota</translation>
    </message>
    <message>
        <source>Save note</source>
        <translation>Salva la nota</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Chiudi</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>Note at this moment</source>
        <translation>Nota su questo momento</translation>
    </message>
    <message>
        <source>Stopped for pain</source>
        <translation>Interrotta per dolore</translation>
    </message>
    <message>
        <source>Strap loosened</source>
        <translation>Cinghia allentata</translation>
    </message>
    <message>
        <source>Rest</source>
        <translation>Riposo</translation>
    </message>
    <message>
        <source>What happened? Enter no names.</source>
        <translation>Che cosa è successo? Non inserire nomi.</translation>
    </message>
    <message>
        <source>Active from here on</source>
        <translation>Attivo da qui</translation>
    </message>
    <message>
        <source>Passive from here on</source>
        <translation>Passivo da qui</translation>
    </message>
</context>
<context>
    <name>NoticeStrip</name>
    <message>
        <source>Later</source>
        <translation>Più tardi</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
</context>
<context>
    <name>NumberCard</name>
    <message>
        <source>{finger}, total active motion (TAM)</source>
        <translation>{finger}, movimento attivo totale (TAM)</translation>
    </message>
    <message>
        <source>{joint}, {side}</source>
        <translation>{joint}, {side}</translation>
    </message>
    <message>
        <source>uncertain, excluded</source>
        <translation>incerto, escluso</translation>
    </message>
    <message>
        <source>uncertain</source>
        <translation>incerto</translation>
    </message>
    <message>
        <source>no value</source>
        <translation>nessun valore</translation>
    </message>
    <message>
        <source>predicted</source>
        <translation>stimato</translation>
    </message>
    <message>
        <source>of {asked}</source>
        <translation>su {asked}</translation>
    </message>
    <message>
        <source>Best today</source>
        <translation>Migliore oggi</translation>
    </message>
    <message>
        <source>Best {movement}</source>
        <translation>Migliore {movement}</translation>
    </message>
    <message>
        <source>Goal {angle}</source>
        <translation>Obiettivo {angle}</translation>
    </message>
    <message>
        <source>Repetitions</source>
        <translation>Ripetizioni</translation>
    </message>
    <message>
        <source>inferred from PIP</source>
        <translation>dedotta dalla IFP</translation>
    </message>
</context>
<context>
    <name>PainDialog</name>
    <message>
        <source>Pain now, 0 (none) to 10 (worst)</source>
        <translation>Dolore ora, da 0 (nessuno) a 10 (massimo)</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Chiudi</translation>
    </message>
    <message>
        <source>If pain is 5 or more, or has risen by 2, stop the exercise. Keys: 0 to 9. For 10, press 1, then 0.</source>
        <translation>Con dolore da 5 in su, o aumentato di 2, interrompere l’esercizio. Tasti: da 0 a 9. Per 10 premere 1, poi 0.</translation>
    </message>
</context>
<context>
    <name>PartRow</name>
    <message>
        <source>times</source>
        <translation>volte</translation>
    </message>
    <message>
        <source>seconds</source>
        <translation>secondi</translation>
    </message>
    <message>
        <source>no rest</source>
        <translation>nessuna</translation>
    </message>
    <message>
        <source>Earlier</source>
        <translation>Su</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Togli</translation>
    </message>
    <message>
        <source>Exercise</source>
        <translation>Esercizio</translation>
    </message>
    <message>
        <source>How often or how long</source>
        <translation>Quante volte o per quanto tempo</translation>
    </message>
    <message>
        <source>Times or seconds</source>
        <translation>Volte o secondi</translation>
    </message>
    <message>
        <source>Rest after it</source>
        <translation>Pausa dopo</translation>
    </message>
</context>
<context>
    <name>PatientCardView</name>
    <message>
        <source>&amp;Edit…</source>
        <translation>&amp;Modifica…</translation>
    </message>
    <message>
        <source>&amp;Other exercise…</source>
        <translation>Altro eser&amp;cizio…</translation>
    </message>
    <message>
        <source>&amp;Review</source>
        <translation>&amp;Revisione</translation>
    </message>
    <message>
        <source>&amp;Progress</source>
        <translation>&amp;Andamento</translation>
    </message>
    <message>
        <source>All &amp;sessions</source>
        <translation>Tutte le &amp;sedute</translation>
    </message>
    <message>
        <source>Simulated: excluded from analysis</source>
        <translation>Simulato: escluso dall’analisi</translation>
    </message>
    <message>
        <source>Place markers as on {day}</source>
        <translation>Applicare i marcatori come in data {day}</translation>
    </message>
    <message>
        <source>No analysed session yet</source>
        <translation>Nessuna seduta ancora analizzata</translation>
    </message>
    <message>
        <source>Only simulated sessions so far (excluded).</source>
        <translation>Finora solo sedute simulate (escluse).</translation>
    </message>
    <message>
        <source>Attach the markers, then start.</source>
        <translation>Applicare i marcatori, poi iniziare.</translation>
    </message>
    <message>
        <source>No session yet</source>
        <translation>Ancora nessuna seduta</translation>
    </message>
    <message>
        <source>Note of {day}</source>
        <translation>Nota, {day}</translation>
    </message>
    <message>
        <source>Start practice</source>
        <translation>Inizia la prova</translation>
    </message>
    <message>
        <source>Start from a file · no camera</source>
        <translation>Inizia da un file · nessuna telecamera</translation>
    </message>
    <message>
        <source>Start first session</source>
        <translation>Inizia la prima seduta</translation>
    </message>
    <message>
        <source>A simulated patient moves in front of a simulated camera. Try every step without a patient.</source>
        <translation>Un paziente simulato si muove davanti a una telecamera simulata. Provare ogni passo senza un paziente.</translation>
    </message>
    <message>
        <source>{ordinal} session</source>
        <translation>{ordinal} seduta</translation>
    </message>
    <message>
        <source>Start session with same set-up</source>
        <translation>Inizia seduta, stessa preparazione</translation>
    </message>
</context>
<context>
    <name>PatientForm</name>
    <message>
        <source>&amp;Another</source>
        <translation>Un &amp;altro</translation>
    </message>
    <message>
        <source>Right</source>
        <translation>Destra</translation>
    </message>
    <message>
        <source>Left</source>
        <translation>Sinistra</translation>
    </message>
    <message>
        <source>Not known</source>
        <translation>Non nota</translation>
    </message>
    <message>
        <source>Real name: {count} characters too long</source>
        <translation>Nome vero: {count} caratteri di troppo</translation>
    </message>
    <message>
        <source>Diagnosis: {count} characters too long</source>
        <translation>Diagnosi: {count} caratteri di troppo</translation>
    </message>
    <message>
        <source>Operation</source>
        <translation>Intervento</translation>
    </message>
    <message>
        <source>Injury</source>
        <translation>Lesione</translation>
    </message>
    <message>
        <source>Close without saving</source>
        <translation>Chiudi senza salvare</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>Edit patient</source>
        <translation>Modificare il paziente</translation>
    </message>
    <message>
        <source>Save changes</source>
        <translation>Salva le modifiche</translation>
    </message>
    <message>
        <source>Affected hand</source>
        <translation>Mano colpita</translation>
    </message>
    <message>
        <source>Writes with</source>
        <translation>Scrive con</translation>
    </message>
    <message>
        <source>&amp;Since</source>
        <translation>Da&amp;l</translation>
    </message>
    <message>
        <source>N&amp;ote (no names)</source>
        <translation>N&amp;ota (nessun nome)</translation>
    </message>
    <message>
        <source>Archi&amp;ve or delete…</source>
        <translation>Archivia o &amp;elimina…</translation>
    </message>
    <message>
        <source>New patient</source>
        <translation>Nuovo paziente</translation>
    </message>
    <message>
        <source>Add patient</source>
        <translation>Aggiungi paziente</translation>
    </message>
    <message>
        <source>Which hand is affected?</source>
        <translation>Quale mano è colpita?</translation>
    </message>
    <message>
        <source>Which hand writes?</source>
        <translation>Con quale mano scrive?</translation>
    </message>
    <message>
        <source>Operation or injury?</source>
        <translation>Intervento o lesione?</translation>
    </message>
    <message>
        <source>&amp;Real name</source>
        <translation>Nome ve&amp;ro</translation>
    </message>
    <message>
        <source>&amp;Birth date</source>
        <translation>Da&amp;ta di nascita</translation>
    </message>
    <message>
        <source>Record nu&amp;mber</source>
        <translation>Nu&amp;mero di cartella</translation>
    </message>
    <message>
        <source>Record number: {count} characters too long</source>
        <translation>Numero di cartella: {count} caratteri di troppo</translation>
    </message>
    <message>
        <source>Sex</source>
        <translation>Sesso</translation>
    </message>
    <message>
        <source>Female</source>
        <translation>Femmina</translation>
    </message>
    <message>
        <source>Male</source>
        <translation>Maschio</translation>
    </message>
    <message>
        <source>&amp;Diagnosis or operation</source>
        <translation>&amp;Diagnosi o intervento</translation>
    </message>
    <message>
        <source>Other</source>
        <translation>Altro</translation>
    </message>
    <message>
        <source>Birth date: {problem}</source>
        <translation>Data di nascita: {problem}</translation>
    </message>
    <message>
        <source>Since: {problem}</source>
        <translation>Dal: {problem}</translation>
    </message>
    <message>
        <source>Save in diagnosis &amp;list</source>
        <translation>Salva nell’elen&amp;co delle diagnosi</translation>
    </message>
    <message>
        <source>Pseudonym: {count} characters too long</source>
        <translation>Pseudonimo: {count} caratteri di troppo</translation>
    </message>
    <message>
        <source>Enter a pseudonym.</source>
        <translation>Inserire uno pseudonimo.</translation>
    </message>
    <message>
        <source>The pseudonym “{name}” is already in use. Choose another one.</source>
        <translation>Lo pseudonimo “{name}” è già usato. Sceglierne un altro.</translation>
    </message>
    <message>
        <source>Pseudo&amp;nym</source>
        <translation>Pseudo&amp;nimo</translation>
    </message>
    <message>
        <source>The pseudonym is shown on all screens and can be spoken aloud: no real name, no initials, no birth date. Real name, birth date, record number, sex and diagnosis are optional. They stay in the patient list and are never in a session file or an export.</source>
        <translation>Lo pseudonimo compare in tutte le schermate e si può dire ad alta voce: nessun nome vero, nessuna iniziale, nessuna data di nascita. Nome vero, data di nascita, numero di cartella, sesso e diagnosi sono facoltativi. Restano nell’elenco dei pazienti, mai in un file di seduta o in un’esportazione.</translation>
    </message>
</context>
<context>
    <name>PatientList</name>
    <message>
        <source>Patients</source>
        <translation>Pazienti</translation>
    </message>
</context>
<context>
    <name>PatientView</name>
    <message>
        <source>{done} of {asked}</source>
        <translation>{done} su {asked}</translation>
    </message>
    <message>
        <source>Goal {angle}</source>
        <translation>Obiettivo {angle}</translation>
    </message>
    <message>
        <source>Goal</source>
        <translation>Obiettivo</translation>
    </message>
</context>
<context>
    <name>PatientWindow</name>
    <message>
        <source>Patient’s view (Esc closes it)</source>
        <translation>Vista del paziente (Esc la chiude)</translation>
    </message>
</context>
<context>
    <name>PatientsScreen</name>
    <message>
        <source>Ctrl+F</source>
        <translation>Ctrl+F</translation>
    </message>
    <message>
        <source>New patient</source>
        <translation>Nuovo</translation>
    </message>
    <message>
        <source>Ctrl+N</source>
        <translation>Ctrl+N</translation>
    </message>
    <message>
        <source>Patients</source>
        <translation>Pazienti</translation>
    </message>
    <message>
        <source>choose</source>
        <translation>scegli</translation>
    </message>
    <message>
        <source>Enter</source>
        <translation>Invio</translation>
    </message>
    <message>
        <source>start</source>
        <translation>inizia</translation>
    </message>
    <message>
        <source>help</source>
        <translation>aiuto</translation>
    </message>
    <message>
        <source>Practice patient</source>
        <translation>Paziente di prova</translation>
    </message>
    <message>
        <source>In the archi&amp;ve: {names}</source>
        <translation>Nell’archi&amp;vio: {names}</translation>
    </message>
    <message>
        <source>found by name</source>
        <translation>trovato per nome</translation>
    </message>
    <message>
        <source>found by birth date</source>
        <translation>trovato per data di nascita</translation>
    </message>
    <message>
        <source>found by record number</source>
        <translation>trovato per numero di cartella</translation>
    </message>
    <message>
        <source>Name, number, birth date</source>
        <translation>Nome, numero, data di nascita</translation>
    </message>
    <message>
        <source>Pseudonym</source>
        <translation>Pseudonimo</translation>
    </message>
</context>
<context>
    <name>PinDialog</name>
    <message>
        <source>&amp;New PIN</source>
        <translation>&amp;Nuovo PIN</translation>
    </message>
    <message>
        <source>Change the PIN</source>
        <translation>Cambiare il PIN</translation>
    </message>
    <message>
        <source>Set a PIN</source>
        <translation>Impostare un PIN</translation>
    </message>
    <message>
        <source>At least four characters, digits or letters. A PIN only hides the screen. It does not encrypt files.</source>
        <translation>Almeno quattro caratteri, cifre o lettere. Un PIN nasconde solo lo schermo. Non cifra i file.</translation>
    </message>
    <message>
        <source>&amp;Current PIN</source>
        <translation>PIN &amp;attuale</translation>
    </message>
    <message>
        <source>Set PIN</source>
        <translation>Imposta il PIN</translation>
    </message>
    <message>
        <source>&amp;Remove PIN</source>
        <translation>&amp;Rimuovi il PIN</translation>
    </message>
    <message>
        <source>Repeat new &amp;PIN</source>
        <translation>Ripetere il nuovo &amp;PIN</translation>
    </message>
    <message>
        <source>A PIN needs at least four characters.</source>
        <translation>Un PIN richiede almeno quattro caratteri.</translation>
    </message>
    <message>
        <source>The two PINs differ.</source>
        <translation>I due PIN sono diversi.</translation>
    </message>
</context>
<context>
    <name>PlaybackControls</name>
    <message>
        <source>Play (Space)</source>
        <translation>Riproduci (Spazio)</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Interrompi</translation>
    </message>
    <message>
        <source>Play</source>
        <translation>Riproduci</translation>
    </message>
    <message>
        <source>{factor}× speed</source>
        <translation>Velocità {factor}×</translation>
    </message>
    <message>
        <source>Previous frame (←)</source>
        <translation>Fotogramma precedente (←)</translation>
    </message>
    <message>
        <source>Next frame (→)</source>
        <translation>Fotogramma seguente (→)</translation>
    </message>
</context>
<context>
    <name>Player</name>
    <message>
        <source>Space</source>
        <translation>Spazio</translation>
    </message>
    <message>
        <source>play</source>
        <translation>riproduci</translation>
    </message>
    <message>
        <source>Repetition…</source>
        <translation>Ripetizione…</translation>
    </message>
    <message>
        <source>frame</source>
        <translation>fotogramma</translation>
    </message>
    <message>
        <source>Mark as passive or excluded (X). [ and ] select another repetition.</source>
        <translation>Segna come passiva o esclusa (X). [ e ] selezionano un’altra ripetizione.</translation>
    </message>
</context>
<context>
    <name>PlotMenu</name>
    <message>
        <source>Show all</source>
        <translation>Mostra tutto</translation>
    </message>
    <message>
        <source>Zoom in</source>
        <translation>Ingrandisci</translation>
    </message>
    <message>
        <source>Zoom out</source>
        <translation>Riduci</translation>
    </message>
    <message>
        <source>Save drawing (SVG)…</source>
        <translation>Salva il disegno (SVG)…</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>Salva</translation>
    </message>
    <message>
        <source>Copy image</source>
        <translation>Copia l’immagine</translation>
    </message>
    <message>
        <source>Save image (PNG)…</source>
        <translation>Salva l’immagine (PNG)…</translation>
    </message>
</context>
<context>
    <name>PracticeSystemCard</name>
    <message>
        <source>Change…</source>
        <translation>Cambia…</translation>
    </message>
    <message>
        <source>Test the folders</source>
        <translation>Verifica le cartelle</translation>
    </message>
    <message>
        <source>Choose a folder</source>
        <translation>Scegliere una cartella</translation>
    </message>
    <message>
        <source>No folder chosen</source>
        <translation>Nessuna cartella scelta</translation>
    </message>
    <message>
        <source>Turn off</source>
        <translation>Disattiva</translation>
    </message>
    <message>
        <source>The clinic software writes a patient as a GDT 2.1 file into the first folder, and Carpus opens the patient. “Send to clinic software” next to a report writes its values and the PDF into the second folder. These files contain real names.</source>
        <translation>Il gestionale salva i dati di un paziente come file GDT 2.1 nella prima cartella, e Carpus apre il paziente. “Invia al gestionale”, accanto a una relazione, salva i valori e il PDF nella seconda. Questi file contengono i nomi veri.</translation>
    </message>
    <message>
        <source>Clinic software (GDT)</source>
        <translation>Gestionale (GDT)</translation>
    </message>
    <message>
        <source>Patients from the clinic software</source>
        <translation>Pazienti dal gestionale</translation>
    </message>
    <message>
        <source>Results for the clinic software</source>
        <translation>Risultati per il gestionale</translation>
    </message>
    <message>
        <source>The demo does not read patients from the clinic software.</source>
        <translation>La demo non legge pazienti dal gestionale.</translation>
    </message>
    <message>
        <source>Write results as FHIR R4 (JSON) too</source>
        <translation>Scrivere i risultati anche come FHIR R4 (JSON)</translation>
    </message>
</context>
<context>
    <name>PreviousPhoto</name>
    <message>
        <source>Last time, {day}</source>
        <translation>Ultima volta, {day}</translation>
    </message>
</context>
<context>
    <name>ProgressChart</name>
    <message>
        <source>Range of motion over the sessions</source>
        <translation>Escursione articolare nel corso delle sedute</translation>
    </message>
    <message>
        <source>{name} {value}, {count} repetitions</source>
        <translation>{name} {value}, {count} ripetizioni</translation>
    </message>
    <message>
        <source>Camera {distance} cm away</source>
        <translation>Telecamera a {distance} cm</translation>
    </message>
    <message>
        <source>Click to open the session</source>
        <translation>Un clic apre la seduta</translation>
    </message>
</context>
<context>
    <name>ProgressFlow</name>
    <message>
        <source>Save table</source>
        <translation>Salva la tabella</translation>
    </message>
    <message>
        <source>progress.csv</source>
        <translation>andamento.csv</translation>
    </message>
</context>
<context>
    <name>ProgressScreen</name>
    <message>
        <source>Progress report</source>
        <translation>Relazione sull’andamento</translation>
    </message>
    <message>
        <source>Save table…</source>
        <translation>Salva la tabella…</translation>
    </message>
    <message>
        <source>Exercise and hand</source>
        <translation>Esercizio e mano</translation>
    </message>
    <message>
        <source>1 session, {last}</source>
        <translation>1 seduta, {last}</translation>
    </message>
    <message>
        <source>{count} sessions, {first} – {last}</source>
        <translation>{count} sedute, {first} – {last}</translation>
    </message>
    <message>
        <source>Reading the sessions…</source>
        <translation>Lettura delle sedute…</translation>
    </message>
    <message>
        <source>The sessions cannot be read.</source>
        <translation>Non è possibile leggere le sedute.</translation>
    </message>
    <message>
        <source>Simulated sessions are shown for practice only and excluded from analysis.</source>
        <translation>Le sedute simulate servono solo per esercitarsi e sono escluse dall’analisi.</translation>
    </message>
    <message>
        <source>{count} sessions, {last}</source>
        <translation>{count} sedute, {last}</translation>
    </message>
    <message>
        <source>First to last session</source>
        <translation>Dalla prima all’ultima seduta</translation>
    </message>
    <message>
        <source>Comparability</source>
        <translation>Confrontabilità</translation>
    </message>
    <message>
        <source>Save image…</source>
        <translation>Salva l’immagine…</translation>
    </message>
    <message>
        <source>&amp;Manual values…</source>
        <translation>Valori &amp;manuali…</translation>
    </message>
    <message>
        <source>Value shown</source>
        <translation>Valore mostrato</translation>
    </message>
    <message>
        <source>Manual measurements</source>
        <translation>Misure manuali</translation>
    </message>
</context>
<context>
    <name>RecordListsController</name>
    <message>
        <source>{n} sessions</source>
        <translation>{n} sedute</translation>
    </message>
    <message>
        <source>session of {day}</source>
        <translation>seduta in data {day}</translation>
    </message>
    <message>
        <source>archived on {day}</source>
        <translation>archiviato in data {day}</translation>
    </message>
    <message>
        <source>Archive</source>
        <translation>Archivio</translation>
    </message>
    <message>
        <source>The archive is empty.</source>
        <translation>L’archivio è vuoto.</translation>
    </message>
    <message>
        <source>1 file</source>
        <translation>1 file</translation>
    </message>
    <message>
        <source>{n} files</source>
        <translation>{n} file</translation>
    </message>
    <message>
        <source>1 value</source>
        <translation>1 valore</translation>
    </message>
    <message>
        <source>{n} values</source>
        <translation>{n} valori</translation>
    </message>
    <message>
        <source>1 study</source>
        <translation>1 studio</translation>
    </message>
    <message>
        <source>{n} studies</source>
        <translation>{n} studi</translation>
    </message>
    <message>
        <source>No record is past its retention period.</source>
        <translation>Per nessun documento è scaduto il periodo di conservazione.</translation>
    </message>
    <message>
        <source>Set the retention period first.</source>
        <translation>Indicare prima il periodo di conservazione.</translation>
    </message>
    <message>
        <source>The last session was more than {n} years ago. Nothing is deleted automatically.</source>
        <translation>L’ultima seduta risale a più di {n} anni fa. Nulla viene eliminato automaticamente.</translation>
    </message>
    <message>
        <source>1 session on {last}, retention until {until}</source>
        <translation>1 seduta ({last}); scadenza della conservazione: {until}</translation>
    </message>
    <message>
        <source>{n} sessions, the last on {last}, retention until {until}</source>
        <translation>{n} sedute, ultima: {last}; scadenza della conservazione: {until}</translation>
    </message>
    <message>
        <source>Excluded from all lists and results. Everything can be restored.</source>
        <translation>Escluso da elenchi e risultati. Tutto si può ripristinare.</translation>
    </message>
    <message>
        <source>1 remaining</source>
        <translation>1 rimasto</translation>
    </message>
    <message>
        <source>{n} remaining</source>
        <translation>{n} rimasti</translation>
    </message>
    <message>
        <source>automatic</source>
        <translation>automatico</translation>
    </message>
    <message>
        <source>de-identified</source>
        <translation>de-identificato</translation>
    </message>
    <message>
        <source>with a PIN</source>
        <translation>con PIN</translation>
    </message>
    <message>
        <source>opened</source>
        <translation>aperto</translation>
    </message>
    <message>
        <source>recorded</source>
        <translation>registrato</translation>
    </message>
    <message>
        <source>added</source>
        <translation>aggiunto</translation>
    </message>
    <message>
        <source>changed</source>
        <translation>modificato</translation>
    </message>
    <message>
        <source>exported</source>
        <translation>esportato</translation>
    </message>
    <message>
        <source>report saved</source>
        <translation>relazione salvata</translation>
    </message>
    <message>
        <source>re-analysed</source>
        <translation>rianalizzato</translation>
    </message>
    <message>
        <source>restored from archive</source>
        <translation>ripristinato dall’archivio</translation>
    </message>
    <message>
        <source>deletion started</source>
        <translation>eliminazione iniziata</translation>
    </message>
    <message>
        <source>deleted</source>
        <translation>eliminato</translation>
    </message>
    <message>
        <source>backup verified</source>
        <translation>copia di sicurezza verificata</translation>
    </message>
    <message>
        <source>backup restored</source>
        <translation>copia di sicurezza ripristinata</translation>
    </message>
    <message>
        <source>wrong PIN</source>
        <translation>PIN sbagliato</translation>
    </message>
    <message>
        <source>manual values entered</source>
        <translation>valori manuali inseriti</translation>
    </message>
    <message>
        <source>moved</source>
        <translation>spostato</translation>
    </message>
    <message>
        <source>excluded</source>
        <translation>escluso</translation>
    </message>
    <message>
        <source>included again</source>
        <translation>incluso di nuovo</translation>
    </message>
    <message>
        <source>exercise changed</source>
        <translation>esercizio cambiato</translation>
    </message>
    <message>
        <source>recovered</source>
        <translation>recuperato</translation>
    </message>
    <message>
        <source>archived</source>
        <translation>archiviato</translation>
    </message>
    <message>
        <source>backed up</source>
        <translation>copia di sicurezza eseguita</translation>
    </message>
    <message>
        <source>locked</source>
        <translation>bloccato</translation>
    </message>
    <message>
        <source>unlocked</source>
        <translation>sbloccato</translation>
    </message>
    <message>
        <source>PIN changed</source>
        <translation>PIN cambiato</translation>
    </message>
    <message>
        <source>log read</source>
        <translation>registro consultato</translation>
    </message>
    <message>
        <source>1 session</source>
        <translation>1 seduta</translation>
    </message>
    <message>
        <source>from the command line</source>
        <translation>dalla riga di comando</translation>
    </message>
    <message>
        <source>Records past their retention period</source>
        <translation>Conservazione scaduta</translation>
    </message>
    <message>
        <source>completed later</source>
        <translation>completato più tardi</translation>
    </message>
</context>
<context>
    <name>RecordingControls</name>
    <message>
        <source>Note</source>
        <translation>Nota</translation>
    </message>
    <message>
        <source>Pain</source>
        <translation>Dolore</translation>
    </message>
    <message>
        <source>Pause</source>
        <translation>Pausa</translation>
    </message>
    <message>
        <source>Pain {score}</source>
        <translation>Dolore {score}</translation>
    </message>
    <message>
        <source>Passive</source>
        <translation>Passivo</translation>
    </message>
    <message>
        <source>Continue</source>
        <translation>Continua</translation>
    </message>
    <message>
        <source>Play and record</source>
        <translation>Riproduci e registra</translation>
    </message>
    <message>
        <source>Record</source>
        <translation>Registra</translation>
    </message>
    <message>
        <source>Stop and next exercise</source>
        <translation>Termina e prossimo esercizio</translation>
    </message>
    <message>
        <source>Stop and review</source>
        <translation>Termina e rivedi</translation>
    </message>
    <message>
        <source>Starting in {seconds} (cancel)</source>
        <translation>Inizio tra {seconds} (annulla)</translation>
    </message>
    <message>
        <source>Space · pedal</source>
        <translation>Spazio · pedale</translation>
    </message>
    <message>
        <source>Saving…</source>
        <translation>Salvataggio…</translation>
    </message>
</context>
<context>
    <name>RecordingPill</name>
    <message>
        <source>Recording {time}</source>
        <translation>Registrazione {time}</translation>
    </message>
    <message>
        <source>Paused at {time}</source>
        <translation>In pausa a {time}</translation>
    </message>
</context>
<context>
    <name>RecordsCard</name>
    <message>
        <source>Records</source>
        <translation>Conservazione</translation>
    </message>
    <message>
        <source>Enter the retention period that the law requires after the last session.</source>
        <translation>Indicare il periodo di conservazione previsto dalla legge dopo l’ultima seduta.</translation>
    </message>
    <message>
        <source>Not set</source>
        <translation>Non indicato</translation>
    </message>
    <message>
        <source>{n} years</source>
        <translation>{n} anni</translation>
    </message>
    <message>
        <source>&amp;Archive…</source>
        <translation>&amp;Archivio…</translation>
    </message>
    <message>
        <source>&amp;Log…</source>
        <translation>Re&amp;gistro…</translation>
    </message>
    <message>
        <source>Past r&amp;etention period…</source>
        <translation>Conservazione scadu&amp;ta…</translation>
    </message>
</context>
<context>
    <name>RecordsDialog</name>
    <message>
        <source>Done</source>
        <translation>Fine</translation>
    </message>
    <message>
        <source>Restore</source>
        <translation>Ripristina</translation>
    </message>
    <message>
        <source>Delete…</source>
        <translation>Elimina…</translation>
    </message>
    <message>
        <source>Archive</source>
        <translation>Archivia</translation>
    </message>
</context>
<context>
    <name>ReportCard</name>
    <message>
        <source>Report</source>
        <translation>Relazione</translation>
    </message>
    <message>
        <source>Name, address and logo of the clinic appear at the top of every page. Empty fields are not printed.</source>
        <translation>Nome, indirizzo e logo del centro compaiono in testa a ogni pagina. I campi vuoti non si stampano.</translation>
    </message>
    <message>
        <source>Clinic name</source>
        <translation>Nome del centro</translation>
    </message>
    <message>
        <source>Address, up to four lines</source>
        <translation>Indirizzo, fino a quattro righe</translation>
    </message>
    <message>
        <source>Logo</source>
        <translation>Logo</translation>
    </message>
    <message>
        <source>Choose a logo…</source>
        <translation>Scegli un logo…</translation>
    </message>
    <message>
        <source>Remove logo</source>
        <translation>Togli il logo</translation>
    </message>
    <message>
        <source>Paper</source>
        <translation>Carta</translation>
    </message>
    <message>
        <source>US Letter</source>
        <translation>US Letter</translation>
    </message>
    <message>
        <source>Images (*.png *.jpg *.jpeg)</source>
        <translation>Immagini (*.png *.jpg *.jpeg)</translation>
    </message>
    <message>
        <source>Choose a logo</source>
        <translation>Scegliere un logo</translation>
    </message>
    <message>
        <source>Print real name, birth date and record number</source>
        <translation>Stampa nome vero, data di nascita e numero di cartella</translation>
    </message>
</context>
<context>
    <name>ReportPanel</name>
    <message>
        <source>Comment</source>
        <translation>Commento</translation>
    </message>
    <message>
        <source>Printed on the report and saved with the session. No names here, please.</source>
        <translation>Stampato sulla relazione e salvato con la seduta. Niente nomi qui, per favore.</translation>
    </message>
    <message>
        <source>Comment on the report</source>
        <translation>Commento alla relazione</translation>
    </message>
    <message>
        <source>Sentence to insert</source>
        <translation>Frase da inserire</translation>
    </message>
    <message>
        <source>Search the saved sentences</source>
        <translation>Cercare tra le frasi salvate</translation>
    </message>
    <message>
        <source>Insert</source>
        <translation>Inserisci</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>Salva</translation>
    </message>
    <message>
        <source>Delete</source>
        <translation>Elimina</translation>
    </message>
    <message>
        <source>Parts of the report</source>
        <translation>Parti della relazione</translation>
    </message>
    <message>
        <source>Use these parts for all reports</source>
        <translation>Usa queste parti per tutte le relazioni</translation>
    </message>
    <message>
        <source>Placeholders for the session’s values: {places}</source>
        <translation>Questi segnaposto vengono sostituiti dai valori della seduta: {places}</translation>
    </message>
    <message>
        <source>Warnings, method and the legal notice are always printed.</source>
        <translation>Avvisi, metodo e avvertenza legale si stampano sempre.</translation>
    </message>
</context>
<context>
    <name>ReportScreen</name>
    <message>
        <source>Save PDF…</source>
        <translation>Salva il PDF…</translation>
    </message>
    <message>
        <source>Open the PDF</source>
        <translation>Apri il PDF</translation>
    </message>
    <message>
        <source>Print…</source>
        <translation>Stampa…</translation>
    </message>
    <message>
        <source>Letter to the doctor…</source>
        <translation>Lettera al medico…</translation>
    </message>
    <message>
        <source>Home exercise sheet…</source>
        <translation>Scheda di esercizi…</translation>
    </message>
    <message>
        <source>Back to the report</source>
        <translation>Torna alla relazione</translation>
    </message>
    <message>
        <source>Preview of the report</source>
        <translation>Anteprima della relazione</translation>
    </message>
    <message>
        <source>One page of US Letter</source>
        <translation>Una pagina US Letter</translation>
    </message>
    <message>
        <source>{count} pages of US Letter</source>
        <translation>{count} pagine US Letter</translation>
    </message>
    <message>
        <source>One page of A4</source>
        <translation>Una pagina A4</translation>
    </message>
    <message>
        <source>{count} pages of A4</source>
        <translation>{count} pagine A4</translation>
    </message>
    <message>
        <source>Not saved yet</source>
        <translation>Non ancora salvata</translation>
    </message>
    <message>
        <source>Save report</source>
        <translation>Salva la relazione</translation>
    </message>
    <message>
        <source>PDF (*.pdf)</source>
        <translation>PDF (*.pdf)</translation>
    </message>
    <message>
        <source>Saved</source>
        <translation>Salvata</translation>
    </message>
    <message>
        <source>{pages}, readable in black and white. Contains the patient’s real name: store it securely.</source>
        <translation>{pages}, leggibile anche in bianco e nero. Contiene il nome vero del paziente: conservare in luogo sicuro.</translation>
    </message>
    <message>
        <source>{pages}, readable in black and white. Contains the pseudonym, not the real name.</source>
        <translation>{pages}, leggibile anche in bianco e nero. Contiene lo pseudonimo, non il nome vero.</translation>
    </message>
    <message>
        <source>Send to clinic software</source>
        <translation>Invia al gestionale</translation>
    </message>
</context>
<context>
    <name>ResultTables</name>
    <message>
        <source>Notes: {notes}</source>
        <translation>Note: {notes}</translation>
    </message>
    <message>
        <source>Pain (0–10): {pains}</source>
        <translation>Dolore (0–10): {pains}</translation>
    </message>
</context>
<context>
    <name>ResultsDialog</name>
    <message>
        <source>&amp;Stop</source>
        <translation>&amp;Interrompi</translation>
    </message>
    <message>
        <source>Progress of the re-analysis</source>
        <translation>Avanzamento della rianalisi</translation>
    </message>
    <message>
        <source>&amp;Keep old result</source>
        <translation>&amp;Tieni il vecchio</translation>
    </message>
    <message>
        <source>&amp;Use new result</source>
        <translation>&amp;Usa il nuovo risultato</translation>
    </message>
    <message>
        <source>Re-analysing: {percent} %</source>
        <translation>Rianalisi: {percent} %</translation>
    </message>
    <message>
        <source>Continue working</source>
        <translation>Continua a lavorare</translation>
    </message>
    <message>
        <source>Reading both results…</source>
        <translation>Lettura dei due risultati…</translation>
    </message>
    <message>
        <source>Decide later</source>
        <translation>Decidi più tardi</translation>
    </message>
    <message>
        <source>Use the new result?</source>
        <translation>Usare il nuovo risultato?</translation>
    </message>
    <message>
        <source>You can continue working. The old result stays until you choose the new one. “Stop” keeps the old result.</source>
        <translation>Si può continuare a lavorare. Il vecchio risultato resta finché non si sceglie il nuovo. “Interrompi” mantiene il vecchio.</translation>
    </message>
</context>
<context>
    <name>RetestDialog</name>
    <message>
        <source>MDC95 from test–retest sessions</source>
        <translation>MDC95 da sedute di test e retest</translation>
    </message>
    <message>
        <source>&amp;Use these values</source>
        <translation>&amp;Usa questi valori</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Annulla</translation>
    </message>
    <message>
        <source>Unreadable sessions: {count}</source>
        <translation>Sedute non leggibili: {count}</translation>
    </message>
    <message>
        <source>Based on people measured more than once, with all markers removed and replaced in between. Shows the standard error of measurement (SEM) and MDC95 with 95 % confidence intervals.</source>
        <translation>Si basa su persone misurate più di una volta, con tutti i marcatori tolti e riapplicati fra una misurazione e l’altra. Mostra l’errore standard di misura (SEM) e l’MDC95 con intervalli di confidenza al 95 %.</translation>
    </message>
</context>
<context>
    <name>ReviewCard</name>
    <message>
        <source>Range of motion</source>
        <translation>Escursione articolare</translation>
    </message>
    <message>
        <source>Exclude</source>
        <translation>Escludi</translation>
    </message>
    <message>
        <source>The session is kept but not analysed. It can be included again.</source>
        <translation>La seduta resta ma non viene analizzata. Si può includere di nuovo.</translation>
    </message>
    <message>
        <source>Side by side…</source>
        <translation>Affianca…</translation>
    </message>
    <message>
        <source>Export…</source>
        <translation>Esporta…</translation>
    </message>
    <message>
        <source>Make report</source>
        <translation>Crea la relazione</translation>
    </message>
    <message>
        <source>older result, excluded</source>
        <translation>risultato precedente, escluso</translation>
    </message>
    <message>
        <source>Include again</source>
        <translation>Includi di nuovo</translation>
    </message>
    <message>
        <source>No other session of this exercise yet.</source>
        <translation>Nessun’altra seduta di questo esercizio.</translation>
    </message>
    <message>
        <source>Measure again</source>
        <translation>Misura di nuovo</translation>
    </message>
    <message>
        <source>Compare with {hand}, {day} (B)</source>
        <translation>Confronta con: {hand}, {day} (B)</translation>
    </message>
</context>
<context>
    <name>ReviewCharts</name>
    <message>
        <source>All fingers</source>
        <translation>Tutte le dita</translation>
    </message>
    <message>
        <source>Wrist</source>
        <translation>Polso</translation>
    </message>
</context>
<context>
    <name>ReviewFlow</name>
    <message>
        <source>This result is used from now on.</source>
        <translation>Da ora si usa questo risultato.</translation>
    </message>
    <message>
        <source>Continue</source>
        <translation>Continua</translation>
    </message>
    <message>
        <source>Save image</source>
        <translation>Salva l’immagine</translation>
    </message>
    <message>
        <source>The other results were not changed.</source>
        <translation>Gli altri risultati non sono stati modificati.</translation>
    </message>
    <message>
        <source>no frame of this session was saved</source>
        <translation>di questa seduta non è stato salvato alcun fotogramma</translation>
    </message>
    <message>
        <source>The result was saved again as the newest one.</source>
        <translation>Il risultato è stato salvato di nuovo come il più recente.</translation>
    </message>
</context>
<context>
    <name>ReviewFrameView</name>
    <message>
        <source>Correct markers…</source>
        <translation>Correggi i marcatori…</translation>
    </message>
    <message>
        <source>A marker is wrong or missing here (Shift+F10)</source>
        <translation>Qui un marcatore è sbagliato o manca (Maiusc+F10)</translation>
    </message>
    <message>
        <source>Angle</source>
        <translation>Angolo</translation>
    </message>
    <message>
        <source>The angle drawn on the frame (A)</source>
        <translation>L’angolo disegnato sul fotogramma (A)</translation>
    </message>
    <message>
        <source>Correct…</source>
        <translation>Correggi…</translation>
    </message>
    <message>
        <source>Not measured here</source>
        <translation>Qui non misurato</translation>
    </message>
    <message>
        <source>No video was saved: markers only</source>
        <translation>Nessun video salvato: solo i marcatori</translation>
    </message>
    <message>
        <source>Repetition {number} of {count} · {time}</source>
        <translation>Ripetizione {number} di {count} · {time}</translation>
    </message>
    <message>
        <source>Save…</source>
        <translation>Salva…</translation>
    </message>
    <message>
        <source>Image of the hand alone (F)</source>
        <translation>Immagine della sola mano (F)</translation>
    </message>
    <message>
        <source>Moves towards the camera: not drawn</source>
        <translation>Movimento verso la telecamera: non disegnato</translation>
    </message>
</context>
<context>
    <name>ReviewScreen</name>
    <message>
        <source>Reading the session…</source>
        <translation>Lettura della seduta…</translation>
    </message>
    <message>
        <source>This session cannot be read. Go back, or choose another one.</source>
        <translation>Questa seduta non è leggibile. Tornare indietro o sceglierne un’altra.</translation>
    </message>
</context>
<context>
    <name>SessionChart</name>
    <message>
        <source>Curves of the session</source>
        <translation>Curve della seduta</translation>
    </message>
    <message>
        <source>Repetitions</source>
        <translation>Ripetizioni</translation>
    </message>
    <message>
        <source>Ctrl+wheel: zoom</source>
        <translation>Ctrl+rotella: zoom</translation>
    </message>
    <message>
        <source>occluded</source>
        <translation>nascosto</translation>
    </message>
</context>
<context>
    <name>SessionList</name>
    <message>
        <source>Sessions</source>
        <translation>Sedute</translation>
    </message>
</context>
<context>
    <name>SessionListModel</name>
    <message>
        <source>ticked</source>
        <translation>selezionata</translation>
    </message>
</context>
<context>
    <name>SessionsScreen</name>
    <message>
        <source>No session yet.</source>
        <translation>Ancora nessuna seduta.</translation>
    </message>
    <message>
        <source>Open in review</source>
        <translation>Apri nella revisione</translation>
    </message>
    <message>
        <source>&amp;Move to another patient…</source>
        <translation>Sposta a un altro &amp;paziente…</translation>
    </message>
    <message>
        <source>Change the &amp;exercise…</source>
        <translation>Cambia l’&amp;esercizio…</translation>
    </message>
    <message>
        <source>Archive or &amp;delete…</source>
        <translation>Archivia o e&amp;limina…</translation>
    </message>
    <message>
        <source>Sessions of {name}</source>
        <translation>Sedute di {name}</translation>
    </message>
    <message>
        <source>Reading…</source>
        <translation>Lettura…</translation>
    </message>
    <message>
        <source>&amp;Include again</source>
        <translation>&amp;Includi di nuovo</translation>
    </message>
    <message>
        <source>E&amp;xclude…</source>
        <translation>Es&amp;cludi…</translation>
    </message>
    <message>
        <source>Which patient does this session belong to?</source>
        <translation>A quale paziente appartiene questa seduta?</translation>
    </message>
    <message>
        <source>Move</source>
        <translation>Sposta</translation>
    </message>
    <message>
        <source>Repetitions and values are calculated again. The recording itself is not changed.</source>
        <translation>Ripetizioni e valori vengono ricalcolati. La registrazione stessa non cambia.</translation>
    </message>
    <message>
        <source>Change exercise</source>
        <translation>Cambia l’esercizio</translation>
    </message>
    <message>
        <source>Which exercise was it?</source>
        <translation>Quale esercizio era?</translation>
    </message>
    <message>
        <source>In the archi&amp;ve: {n}</source>
        <translation>Nell’archi&amp;vio: {n}</translation>
    </message>
    <message>
        <source>Show &amp;progress</source>
        <translation>Mostra l’&amp;andamento</translation>
    </message>
    <message>
        <source>The session will move from {name}’s progress to the other patient’s.</source>
        <translation>La seduta passa dall’andamento di {name} a quello dell’altro paziente.</translation>
    </message>
    <message>
        <source>Tick two sessions to compare</source>
        <translation>Selezionarne due da confrontare</translation>
    </message>
    <message>
        <source>Tick one more session to compare</source>
        <translation>Selezionarne un’altra</translation>
    </message>
    <message>
        <source>Compare the 2 ticked sessions</source>
        <translation>Confronta le 2 selezionate</translation>
    </message>
</context>
<context>
    <name>SetDialog</name>
    <message>
        <source>No patient names</source>
        <translation>Niente nomi di pazienti</translation>
    </message>
    <message>
        <source>Name of the set</source>
        <translation>Nome della sequenza</translation>
    </message>
    <message>
        <source>Add an exercise</source>
        <translation>Aggiungi un esercizio</translation>
    </message>
    <message>
        <source>Delete this set</source>
        <translation>Elimina questa sequenza</translation>
    </message>
    <message>
        <source>Save the set</source>
        <translation>Salva la sequenza</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Chiudi</translation>
    </message>
    <message>
        <source>Exercise</source>
        <translation>Esercizio</translation>
    </message>
    <message>
        <source>How much</source>
        <translation>Quanto</translation>
    </message>
    <message>
        <source>Rest after it</source>
        <translation>Pausa dopo</translation>
    </message>
    <message>
        <source>New set</source>
        <translation>Nuova sequenza</translation>
    </message>
    <message>
        <source>Another set has this name.</source>
        <translation>Un’altra sequenza ha questo nome.</translation>
    </message>
    <message>
        <source>Delete “{name}”? Press again</source>
        <translation>Eliminare “{name}”? Premere di nuovo</translation>
    </message>
    <message>
        <source>Exercise set</source>
        <translation>Sequenza</translation>
    </message>
    <message>
        <source>Exercise sets</source>
        <translation>Sequenze di esercizi</translation>
    </message>
    <message>
        <source>Exercises that run one after the other with the same markers. Each is saved as its own session.</source>
        <translation>Esercizi che si seguono con gli stessi marcatori. Ognuno viene salvato come seduta a sé.</translation>
    </message>
    <message>
        <source>Enter a name for the set.</source>
        <translation>Inserire un nome per la sequenza.</translation>
    </message>
    <message>
        <source>Add an exercise to the set.</source>
        <translation>Aggiungere un esercizio alla sequenza.</translation>
    </message>
</context>
<context>
    <name>SettingsFlow</name>
    <message>
        <source>Folder with the test–retest sessions</source>
        <translation>Cartella con le sedute di test e retest</translation>
    </message>
</context>
<context>
    <name>SettingsScreen</name>
    <message>
        <source>Light</source>
        <translation>Chiaro</translation>
    </message>
    <message>
        <source>Dark</source>
        <translation>Scuro</translation>
    </message>
    <message>
        <source>Change…</source>
        <translation>Cambia…</translation>
    </message>
    <message>
        <source>Hands-free start: use a pedal or a presentation remote (Page Down). An automatic start is counted down, and Space cancels it.</source>
        <translation>Avvio a mani libere: usare un pedale o un telecomando per presentazioni (Pag giù). L’avvio automatico è preceduto da un conto alla rovescia. La barra spaziatrice lo annulla.</translation>
    </message>
    <message>
        <source>Calculate from test–retest sessions…</source>
        <translation>Calcola da sedute di test e retest…</translation>
    </message>
    <message>
        <source>Match system</source>
        <translation>Come il sistema</translation>
    </message>
    <message>
        <source>ISB: flexion first</source>
        <translation>ISB: prima la flessione</translation>
    </message>
    <message>
        <source>On key press</source>
        <translation>Alla pressione del tasto</translation>
    </message>
    <message>
        <source>3 s after key press</source>
        <translation>3 s dopo la pressione</translation>
    </message>
    <message>
        <source>When the hand is still</source>
        <translation>Con la mano ferma</translation>
    </message>
    <message>
        <source>Beep at the goal</source>
        <translation>Segnale all’obiettivo</translation>
    </message>
    <message>
        <source>Off</source>
        <translation>Spento</translation>
    </message>
    <message>
        <source>Stream live values</source>
        <translation>Trasmetti i valori dal vivo</translation>
    </message>
    <message>
        <source>Appearance</source>
        <translation>Aspetto</translation>
    </message>
    <message>
        <source>Carpus never checks for updates online. Compare this version with the latest one where you got Carpus. Back up, then install it over this one. Patients, sessions and settings stay.</source>
        <translation>Carpus non cerca mai aggiornamenti in rete. Confrontare questa versione con l’ultima disponibile dove è stato ottenuto Carpus. Eseguire una copia di sicurezza, poi installare la nuova versione sopra questa. Pazienti, sedute e impostazioni restano.</translation>
    </message>
    <message>
        <source>Components and licences</source>
        <translation>Componenti e licenze</translation>
    </message>
    <message>
        <source>Appearance and language</source>
        <translation>Aspetto e lingua</translation>
    </message>
    <message>
        <source>No sound</source>
        <translation>Nessun suono</translation>
    </message>
    <message>
        <source>For research</source>
        <translation>Per la ricerca</translation>
    </message>
    <message>
        <source>Done</source>
        <translation>Fine</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>Colours</source>
        <translation>Colori</translation>
    </message>
    <message>
        <source>Text size</source>
        <translation>Dimensione del testo</translation>
    </message>
    <message>
        <source>Language</source>
        <translation>Lingua</translation>
    </message>
    <message>
        <source>Angle order</source>
        <translation>Ordine degli angoli</translation>
    </message>
    <message>
        <source>Order of the wrist angles in review, progress and reports. Session files keep the papers’ order (ZYX). Sessions with different orders are not compared.</source>
        <translation>Ordine degli angoli del polso in revisione, andamento e relazioni. I file delle sedute mantengono l’ordine degli articoli scientifici (ZYX). Sedute con ordini diversi non si confrontano.</translation>
    </message>
    <message>
        <source>Streams angles, positions and events over Lab Streaming Layer (LSL). Any computer on the network can read them. Names and images are not included. Applies from the next set-up.</source>
        <translation>Trasmette angoli, posizioni ed eventi con Lab Streaming Layer (LSL). Ogni computer della rete può leggerli. Nomi e immagini non sono inclusi. Vale dalla prossima preparazione.</translation>
    </message>
    <message>
        <source>Sessions and patient list. Private to your user account. Nothing leaves this computer.</source>
        <translation>Sedute ed elenco dei pazienti. Riservati all’account utente. Nulla lascia questo computer.</translation>
    </message>
    <message>
        <source>Data</source>
        <translation>Dati</translation>
    </message>
    <message>
        <source>Research</source>
        <translation>Ricerca</translation>
    </message>
    <message>
        <source>Other programs</source>
        <translation>Altri programmi</translation>
    </message>
    <message>
        <source>Start of a recording</source>
        <translation>Inizio di una registrazione</translation>
    </message>
    <message>
        <source>The patient’s view</source>
        <translation>La vista del paziente</translation>
    </message>
    <message>
        <source>About Carpus</source>
        <translation>Informazioni su Carpus</translation>
    </message>
    <message>
        <source>Version {version}, MIT licence.</source>
        <translation>Versione {version}, licenza MIT.</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Telecamera</translation>
    </message>
    <message>
        <source>Measuring</source>
        <translation>Misurazione</translation>
    </message>
    <message>
        <source>Report and clinic</source>
        <translation>Relazione e centro</translation>
    </message>
    <message>
        <source>Safety</source>
        <translation>Sicurezza</translation>
    </message>
    <message>
        <source>Settings</source>
        <translation>Impostazioni</translation>
    </message>
    <message>
        <source>Data folder</source>
        <translation>Cartella dei dati</translation>
    </message>
    <message>
        <source>Reading the sessions…</source>
        <translation>Lettura delle sedute…</translation>
    </message>
    <message>
        <source>A second screen or window shows the patient what to do. Open it while measuring. For each exercise, choose whether it speaks to a child or an adult.</source>
        <translation>Un secondo schermo o una finestra mostra al paziente che cosa fare. Si apre durante la misurazione. Con l’esercizio si sceglie se si rivolge a un bambino o a un adulto.</translation>
    </message>
    <message>
        <source>As published: deviation first</source>
        <translation>Come pubblicato: prima la deviazione</translation>
    </message>
    <message>
        <source>In the demo, settings apply until it is closed.</source>
        <translation>Nella demo le impostazioni valgono solo fino alla chiusura.</translation>
    </message>
    <message>
        <source>Shows path and axes, speeds, the motion page in reports, all export formats, angle order and streaming. Values do not change.</source>
        <translation>Mostra percorso e assi, velocità, la pagina del movimento nelle relazioni, tutti i formati di esportazione, ordine degli angoli e streaming. I valori non cambiano.</translation>
    </message>
</context>
<context>
    <name>StartAngleDialog</name>
    <message>
        <source>The wrist cannot reach neutral</source>
        <translation>Il polso non raggiunge la posizione neutra</translation>
    </message>
    <message>
        <source>Use these angles</source>
        <translation>Usa questi angoli</translation>
    </message>
    <message>
        <source>Enter the wrist and forearm angles now, measured with a goniometer. Palm flat on the table is 90° pronation. Carpus adds them to all wrist angles and notes it in the report. Bent fingers need no entry.</source>
        <translation>Inserire gli angoli attuali di polso e avambraccio, misurati con il goniometro. Il palmo piatto sul tavolo corrisponde a 90° di pronazione. Carpus li aggiunge a tutti gli angoli del polso e lo annota nella relazione. Per le dita flesse non serve inserire nulla.</translation>
    </message>
    <message>
        <source>Wrist is in neutral</source>
        <translation>Il polso è in posizione neutra</translation>
    </message>
</context>
<context>
    <name>StraightFingers</name>
    <message>
        <source>Are the fingers straight?</source>
        <translation>Le dita sono estese?</translation>
    </message>
    <message>
        <source>{finger} bent</source>
        <translation>{finger} piegato</translation>
    </message>
    <message>
        <source>Click a finger that cannot fully extend (keys 1 to 5).</source>
        <translation>Fare clic su un dito che non si estende del tutto (tasti da 1 a 5).</translation>
    </message>
    <message>
        <source>A bent finger is measured from its own resting position, which is less accurate.</source>
        <translation>Un dito piegato si misura dalla sua posizione di riposo, con minore precisione.</translation>
    </message>
</context>
<context>
    <name>TherapistCard</name>
    <message>
        <source>Initials</source>
        <translation>Iniziali</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Nome</translation>
    </message>
    <message>
        <source>Therapists</source>
        <translation>Terapisti</translation>
    </message>
    <message>
        <source>Sessions, reports, letters and the log carry the therapist’s initials. Choose the therapist in the top bar. Clear the initials to remove a therapist.</source>
        <translation>Sedute, relazioni, lettere e registro riportano le iniziali del terapista. Il terapista si sceglie nella barra in alto. Per togliere un terapista, cancellare le iniziali.</translation>
    </message>
</context>
<context>
    <name>TherapistController</name>
    <message>
        <source>Edit the list…</source>
        <translation>Modifica l’elenco…</translation>
    </message>
</context>
<context>
    <name>TimeSlider</name>
    <message>
        <source>Time in the session</source>
        <translation>Tempo nella seduta</translation>
    </message>
</context>
<context>
    <name>TopBar</name>
    <message>
        <source>Back (Esc)</source>
        <translation>Indietro (Esc)</translation>
    </message>
    <message>
        <source>Help (F1)</source>
        <translation>Aiuto (F1)</translation>
    </message>
    <message>
        <source>Settings (Ctrl+,)</source>
        <translation>Impostazioni (Ctrl+,)</translation>
    </message>
    <message>
        <source>Hide names (Ctrl+D)</source>
        <translation>Nascondi i nomi (Ctrl+D)</translation>
    </message>
    <message>
        <source>Therapist: {initials}</source>
        <translation>Terapista: {initials}</translation>
    </message>
    <message>
        <source>Choose a therapist</source>
        <translation>Scegli il terapista</translation>
    </message>
    <message>
        <source>Therapist</source>
        <translation>Terapista</translation>
    </message>
    <message>
        <source>Show names (Ctrl+D)</source>
        <translation>Mostra i nomi (Ctrl+D)</translation>
    </message>
    <message>
        <source>Available after the recording</source>
        <translation>Disponibile dopo la registrazione</translation>
    </message>
</context>
<context>
    <name>TopBarController</name>
    <message>
        <source>Exercise</source>
        <translation>Esercizio</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Telecamera</translation>
    </message>
    <message>
        <source>Markers</source>
        <translation>Marcatori</translation>
    </message>
    <message>
        <source>Measure</source>
        <translation>Misura</translation>
    </message>
    <message>
        <source>Sessions</source>
        <translation>Sedute</translation>
    </message>
    <message>
        <source>Review</source>
        <translation>Revisione</translation>
    </message>
    <message>
        <source>Progress</source>
        <translation>Andamento</translation>
    </message>
    <message>
        <source>Report</source>
        <translation>Relazione</translation>
    </message>
    <message>
        <source>Measured although uncertain: {findings}</source>
        <translation>Misurata nonostante l’incertezza: {findings}</translation>
    </message>
    <message>
        <source>Saved {time}</source>
        <translation>Salvata {time}</translation>
    </message>
    <message>
        <source>Simulated camera</source>
        <translation>Telecamera simulata</translation>
    </message>
    <message>
        <source>Recording {name}</source>
        <translation>Registrazione {name}</translation>
    </message>
    <message>
        <source>Camera ready</source>
        <translation>Telecamera pronta</translation>
    </message>
    <message>
        <source>No camera</source>
        <translation>Nessuna telecamera</translation>
    </message>
    <message>
        <source>{percent} %</source>
        <translation>{percent} %</translation>
    </message>
    <message>
        <source>{count} new results: choose</source>
        <translation>{count} nuovi risultati: scegliere</translation>
    </message>
    <message>
        <source>Choose</source>
        <translation>Scegli</translation>
    </message>
    <message>
        <source>{count} fps</source>
        <translation>{count} fps</translation>
    </message>
    <message>
        <source>{count} fps (below {least})</source>
        <translation>{count} fps (sotto {least})</translation>
    </message>
    <message>
        <source>This session is excluded from analysis.</source>
        <translation>Questa seduta è esclusa dall’analisi.</translation>
    </message>
    <message>
        <source>Re-analysing {percent}</source>
        <translation>Rianalisi {percent}</translation>
    </message>
    <message>
        <source>Progress and Stop</source>
        <translation>Avanzamento e interruzione</translation>
    </message>
    <message>
        <source>Old and new result overlaid</source>
        <translation>Vecchio e nuovo sovrapposti</translation>
    </message>
    <message>
        <source>New result: choose one</source>
        <translation>Nuovo risultato: scegliere</translation>
    </message>
    <message>
        <source>Space for {time}</source>
        <translation>spazio per {time}</translation>
    </message>
    <message>
        <source>This is a simulated hand, not {name}. It is excluded from analysis.</source>
        <translation>Questa è una mano simulata, non di {name}. È esclusa dall’analisi.</translation>
    </message>
    <message>
        <source>{words}, {lost} frames dropped</source>
        <translation>{words}, {lost} persi</translation>
    </message>
    <message>
        <source>The clinic’s server does not respond. Until it does, patients and sessions cannot be shown or changed. You can still measure.</source>
        <translation>Il server del centro non risponde. Fino ad allora pazienti e sedute non si possono mostrare né modificare. Si può continuare a misurare.</translation>
    </message>
</context>
<context>
    <name>VerdictPanel</name>
    <message>
        <source>good</source>
        <translation>buono</translation>
    </message>
    <message>
        <source>uncertain</source>
        <translation>incerto</translation>
    </message>
    <message>
        <source>wrong</source>
        <translation>sbagliato</translation>
    </message>
    <message>
        <source>open</source>
        <translation>da fare</translation>
    </message>
</context>
<context>
    <name>VersionChoice</name>
    <message>
        <source>Results of this recording</source>
        <translation>Risultati di questa registrazione</translation>
    </message>
    <message>
        <source>{number} · {day}</source>
        <translation>{number} · {day}</translation>
    </message>
    <message>
        <source>{result}, in use</source>
        <translation>{result}, in uso</translation>
    </message>
    <message>
        <source>Use this result</source>
        <translation>Usa questo risultato</translation>
    </message>
</context>
<context>
    <name>WelcomeController</name>
    <message>
        <source>Screen</source>
        <translation>Schermo</translation>
    </message>
    <message>
        <source>Install Carpus again: part of it is missing or damaged.</source>
        <translation>Installare di nuovo Carpus: una parte manca o è danneggiata.</translation>
    </message>
    <message>
        <source>Fonts</source>
        <translation>Caratteri</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Telecamera</translation>
    </message>
    <message>
        <source>Camera driver</source>
        <translation>Driver della telecamera</translation>
    </message>
    <message>
        <source>Data folder</source>
        <translation>Cartella dei dati</translation>
    </message>
    <message>
        <source>Disk</source>
        <translation>Disco</translation>
    </message>
    <message>
        <source>Camera permissions</source>
        <translation>Permessi della telecamera</translation>
    </message>
    <message>
        <source>In the display settings, choose a higher resolution or a smaller scale: {width} × {height} or more.</source>
        <translation>Nelle impostazioni dello schermo scegliere una risoluzione maggiore o una scala minore: {width} × {height} o più.</translation>
    </message>
    <message>
        <source>the fonts of Carpus cannot be loaded</source>
        <translation>i caratteri di Carpus non si possono caricare</translation>
    </message>
    <message>
        <source>{width} × {height} usable</source>
        <translation>{width} × {height} utilizzabili</translation>
    </message>
</context>
<context>
    <name>WelcomePanel</name>
    <message>
        <source>Another &amp;folder…</source>
        <translation>Un’altra cart&amp;ella…</translation>
    </message>
    <message>
        <source>Close Carpus</source>
        <translation>Chiudi Carpus</translation>
    </message>
    <message>
        <source>&amp;Look again</source>
        <translation>Verifica di &amp;nuovo</translation>
    </message>
    <message>
        <source>&amp;Details</source>
        <translation>&amp;Dettagli</translation>
    </message>
    <message>
        <source>&amp;Guide me through a first session</source>
        <translation>&amp;Guidami in una prima seduta</translation>
    </message>
    <message>
        <source>Not now</source>
        <translation>Non ora</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Esc</translation>
    </message>
    <message>
        <source>Welcome to Carpus</source>
        <translation>Benvenuti in Carpus</translation>
    </message>
    <message>
        <source>Patients and sessions are saved here. Nothing leaves this computer.</source>
        <translation>Pazienti e sedute vengono salvati qui. Nulla lascia questo computer.</translation>
    </message>
    <message>
        <source>Checking this computer …</source>
        <translation>Verifica di questo computer …</translation>
    </message>
    <message>
        <source>This computer has everything that Carpus needs.</source>
        <translation>Questo computer ha tutto ciò che serve a Carpus.</translation>
    </message>
    <message>
        <source>One thing needs your attention. The practice patient works without it.</source>
        <translation>C’è una cosa da fare. Per il paziente di prova non serve.</translation>
    </message>
    <message>
        <source>{count} things need your attention. The practice patient works without them.</source>
        <translation>Ci sono {count} cose da fare. Per il paziente di prova non servono.</translation>
    </message>
    <message>
        <source>The new folder is used from the next start. Close Carpus and open it again before you measure.</source>
        <translation>La cartella vale dal prossimo avvio: chiudere Carpus e riaprirlo prima di misurare.</translation>
    </message>
    <message>
        <source>Pseudonym only</source>
        <translation>Solo lo pseudonimo</translation>
    </message>
    <message>
        <source>Real name too</source>
        <translation>Anche il nome vero</translation>
    </message>
    <message>
        <source>What should reports and letters print?</source>
        <translation>Che cosa stampare su relazioni e lettere?</translation>
    </message>
</context>
<context>
    <name>ZoomChart</name>
    <message>
        <source>Zoom, copy and save</source>
        <translation>Zoom, copia e salva</translation>
    </message>
</context>
<context>
    <name>_EmptyView</name>
    <message>
        <source>No patient “{name}”.</source>
        <translation>Nessun paziente “{name}”.</translation>
    </message>
    <message>
        <source>Create “{name}”</source>
        <translation>Crea “{name}”</translation>
    </message>
    <message>
        <source>No patients yet. Add the first one, or try everything with the practice patient.</source>
        <translation>Ancora nessun paziente. Aggiungere il primo, o provare tutto con il paziente di prova.</translation>
    </message>
</context>
<context>
    <name>_OfflineView</name>
    <message>
        <source>Measure “{name}”</source>
        <translation>Misura “{name}”</translation>
    </message>
    <message>
        <source>Measure without the patient list</source>
        <translation>Misura senza l’elenco dei pazienti</translation>
    </message>
    <message>
        <source>The patient list returns when the server responds. To measure now, enter the patient’s pseudonym above. The session is saved and appears in the list later.</source>
        <translation>L’elenco dei pazienti torna quando il server risponde. Per misurare ora, inserire qui sopra lo pseudonimo del paziente. La seduta viene salvata e compare più tardi nell’elenco.</translation>
    </message>
</context>
</TS>
